// What the options of several rigs must hold, and their usual units.
#pragma once

#include <numbers>

#include "base/problems.h"
#include "base/units.h"

namespace talus::rigs {

inline constexpr double kRpm = 2 * std::numbers::pi / 60;  // [rad/s]
inline constexpr double kLargestLength = 2;                // [m]

inline void RequireLength(base::Problems& problems, const char* key, double value) {
  problems.Require(value > 0 && value <= kLargestLength, key, value,
                   "must be positive and at most 2 m; write \"10 mm\" for 10 mm");
}

}  // namespace talus::rigs
