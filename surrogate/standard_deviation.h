// Standard deviation of a set of values.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace talus::surrogate {

// The whole population's: divides by n, not n - 1. At least one value.
inline double StandardDeviation(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

}  // namespace talus::surrogate
