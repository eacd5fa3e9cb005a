// The prior covariance of a Gaussian process on the unit cube: a constant, a trend and a stationary
// part, all in one kernel, so that no trend needs a minimum number of points.
//
//   k(x, x') = c² + t² (p + p²) + s² ρ(Σ ((xₖ - x'ₖ) / ℓₖ)²),   p = z·z',  z = 2x - 1
//
// p and p² are the kernels of a linear and of a full quadratic polynomial; t = 0 is the constant
// trend. ℓ correlation lengths [-], s signal, t trend, n noise, c constant: standard deviations in
// units of the scaled values (GaussianProcess scales them to mean 0, standard deviation 1). x are
// warped coordinates (warp.h) where there is input warping; GaussianProcess warps them.
#pragma once

#include <Eigen/Core>

#include "surrogate/process/kernel.h"

namespace talus::surrogate {

enum class Trend { kConstant, kQuadratic };

struct Hyperparameters {
  Eigen::VectorXd length = {};  // ℓ, one a coordinate
  double signal = 1;            // s
  double trend = 0;             // t
  double noise = 0;             // n, of one evaluation
  Eigen::VectorXd warp = {};    // strength of each coordinate (warp.h); empty: none
};

// c: wide enough that the mean of the values costs nothing, since they are scaled to mean 0.
inline constexpr double kConstantSd = 2;

class Covariance {
 public:
  Covariance(Kernel kernel, Hyperparameters hyper);

  // Points are columns here: d × n, so that one point is contiguous.
  double At(const double* a, const double* b) const;
  Eigen::MatrixXd Between(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const;
  Eigen::VectorXd Diagonal(const Eigen::MatrixXd& points) const;

  // ∂k(x, b_j)/∂x, one column for each column b_j of `b`.
  Eigen::MatrixXd Gradient(const Eigen::VectorXd& x, const Eigen::MatrixXd& b) const;
  Eigen::VectorXd DiagonalGradient(const Eigen::VectorXd& x) const;  // d k(x, x) / dx

  const Hyperparameters& hyper() const { return hyper_; }

 private:
  Kernel kernel_;
  Hyperparameters hyper_;
  Eigen::VectorXd inverse_length_;
};

}  // namespace talus::surrogate
