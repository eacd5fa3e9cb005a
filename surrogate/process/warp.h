// A monotone map of the unit interval onto itself that stretches one end and compresses the other.
//
//   w(u) = (exp(c u) - 1) / (exp(c) - 1)        c: bend [-]; c = 0: w = u
//
// Heaps saturate: from no friction to a little they change more than over the rest of the range. A
// stationary covariance of bent coordinates can follow that, one of the parameters themselves
// cannot.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace talus::surrogate {

struct Bent {
  double value = 0;       // w
  double slope = 1;       // dw/du
  double bend_slope = 0;  // dw/dc
};

inline Bent BendAt(double u, double bend) {
  if (std::abs(bend) < 1e-3) {  // to third order; the closed form cancels there
    const double hump = u * (u - 1);
    const double skew = hump * (2 * u - 1);
    return {.value = u + bend * hump / 2 + bend * bend * skew / 12,
            .slope = 1 + bend * (2 * u - 1) / 2 + bend * bend * (6 * hump + 1) / 12,
            .bend_slope = hump / 2 + bend * skew / 6};
  }
  const double whole = std::expm1(bend);
  const double part = std::expm1(bend * u);
  return {.value = part / whole,
          .slope = bend * (part + 1) / whole,
          .bend_slope = (u * (part + 1) - part / whole * (whole + 1)) / whole};
}

// Points are columns. `bends`: one a coordinate, or empty for none.
inline Eigen::MatrixXd BendAll(const Eigen::MatrixXd& points, const Eigen::VectorXd& bends) {
  if (bends.size() == 0) return points;
  Eigen::MatrixXd bent(points.rows(), points.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      bent(k, j) = BendAt(points(k, j), bends[k]).value;
    }
  }
  return bent;
}

}  // namespace talus::surrogate
