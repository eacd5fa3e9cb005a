// The walls that a rig opens by taking them away.
#pragma once

#include <algorithm>
#include <string_view>

#include "engine/bodies/wall.h"

namespace talus::rigs {

inline constexpr int kGate = 0;  // index of the wall where a scene has one alone

// By its name: what holds the powder until the test begins, and stands nowhere at its end.
inline bool IsGate(const engine::Wall& wall) {
  constexpr std::string_view kNames[] = {"gate", "rear gate", "weir"};
  return std::ranges::find(kNames, wall.name) != std::ranges::end(kNames);
}

}  // namespace talus::rigs
