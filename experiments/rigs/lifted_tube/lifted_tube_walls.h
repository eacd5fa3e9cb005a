// The walls of the lifted tube's scene, by their indices.
#pragma once

namespace talus::rigs {

inline constexpr int kTube = 0;
inline constexpr int kPlate = 1;

}  // namespace talus::rigs
