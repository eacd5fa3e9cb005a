// A monotone map of the unit interval onto itself that stretches one end and compresses the other.
//
//   w(u) = (exp(c u) - 1) / (exp(c) - 1)        c: warp strength [-]; c = 0: w = u
//
// Input warping. Heaps saturate: from no friction to a little they change more than over the rest
// of the range. A stationary covariance of warped coordinates follows that; one of the parameters
// themselves cannot.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace talus::surrogate {

struct Warped {
  double value = 0;       // w
  double slope = 1;       // dw/du
  double warp_slope = 0;  // dw/dc
};

inline Warped WarpAt(double u, double strength) {
  if (std::abs(strength) < 1e-3) {  // to third order; the closed form cancels there
    const double hump = u * (u - 1);
    const double skew = hump * (2 * u - 1);
    return {.value = u + strength * hump / 2 + strength * strength * skew / 12,
            .slope = 1 + strength * (2 * u - 1) / 2 + strength * strength * (6 * hump + 1) / 12,
            .warp_slope = hump / 2 + strength * skew / 6};
  }
  const double whole = std::expm1(strength);
  const double part = std::expm1(strength * u);
  return {.value = part / whole,
          .slope = strength * (part + 1) / whole,
          .warp_slope = (u * (part + 1) - part / whole * (whole + 1)) / whole};
}

// Points are columns. `strengths`: one a coordinate, or empty for none.
inline Eigen::MatrixXd WarpAll(const Eigen::MatrixXd& points, const Eigen::VectorXd& strengths) {
  if (strengths.size() == 0) return points;
  Eigen::MatrixXd warped(points.rows(), points.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      warped(k, j) = WarpAt(points(k, j), strengths[k]).value;
    }
  }
  return warped;
}

}  // namespace talus::surrogate
