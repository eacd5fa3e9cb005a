// The standard normal distribution.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::base {

// φ(z)
inline double NormalDensity(double z) {
  return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

// Φ(z)
inline double NormalProbability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace talus::base
