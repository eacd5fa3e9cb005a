// Angles whose bare number is one of degrees, most likely, and is read as one of radians.
#pragma once

#include <string>

#include "base/problems.h"

namespace talus::campaign {

inline constexpr double kLargestAngleError = 0.5;  // [rad]

// Adds a problem for an angle [rad] above `most`, with the unit that it lacks, perhaps.
void RequireAngle(base::Problems& problems, const std::string& path, double angle, double most);

// The same for an error of an angle, or for how well it is to be known [rad].
inline void RequireAngleError(base::Problems& problems, const std::string& path, double error) {
  RequireAngle(problems, path, error, kLargestAngleError);
}

}  // namespace talus::campaign
