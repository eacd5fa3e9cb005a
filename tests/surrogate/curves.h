// Curves along 30 places that depend on two parameters in three smooth ways.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace talus::test {

constexpr int kElements = 30;

// `x`: two parameters in [0, 1].
inline Eigen::VectorXd Curve(const Eigen::VectorXd& x) {
  Eigen::VectorXd curve(kElements);
  for (Eigen::Index i = 0; i < curve.size(); ++i) {
    const double s = static_cast<double>(i) / kElements;
    curve[i] = 3 * std::sin(2 * x[0]) * s + x[0] * x[1] * std::cos(3 * s) + x[1] * x[1] * s * s;
  }
  return curve;
}

}  // namespace talus::test
