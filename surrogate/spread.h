// How far values lie from their mean.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace talus::surrogate {

// Standard deviation of the values themselves, as of a whole population. At least one value.
inline double Spread(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

}  // namespace talus::surrogate
