// The standard normal distribution.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::base {

inline const double kLogRootTwoPi = 0.5 * std::log(2 * std::numbers::pi);  // ln √(2π)

// φ(z)
inline double NormalDensity(double z) {
  return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

// Φ(z)
inline double NormalProbability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace talus::base
