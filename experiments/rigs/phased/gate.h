// The wall that a rig opens by taking it away: scenes with one put it first.
#pragma once

namespace talus::rigs {

inline constexpr int kGate = 0;  // index of the wall

}  // namespace talus::rigs
