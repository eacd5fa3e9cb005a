// The prior covariance of a Gaussian process on the unit cube: a constant, a trend and a stationary
// part, all in one kernel, so that no trend needs a minimum number of points.
//
//   k(x, x') = c² + t² (p + p²) + s² ρ(q),   p = z·z',  z = 2x - 1,  q = Σ ((xₖ - x'ₖ) / ℓₖ)²
//
// p and p² are the kernels of a linear and of a full quadratic polynomial; t = 0 is the constant
// trend. Where an output is simulated at several scale factors f, it is what it is at the target
// and a discrepancy that grows from zero there:
//
//   y(x, f) = e^(-a g) y(x) + g d₁(x) + (g² - g) d₂(x) + noise
//   g = (f - f_target)/(f_coarsest - f_target)
//
//   cov d₁ = cov d₂ = u² (1 + p/2 + ρ(q/λ²));   e^(-a g) leaves c² as it is
//
// A noisy linear autoregressive model [kennedy2000] with coefficient e^(-a g), written as one
// process with the scale factor as input, so that designs need not be nested. With a large a coarse
// evaluations carry no information on the target. d₂ vanishes at the target and at the coarsest
// scale factor: it says how far the growth may be from linear.
//
// ℓ correlation lengths [-], s signal, t trend, u discrepancy, c constant: standard deviations in
// units of the scaled values (GaussianProcess scales them). x are warped coordinates (warp.h) where
// there is input warping; GaussianProcess warps them.
#pragma once

#include <Eigen/Core>

#include "surrogate/process/hyperparameters.h"
#include "surrogate/process/kernel.h"

namespace talus::surrogate {

// Points as columns, d × n, so that one point is contiguous, and the growth g of each.
struct Sites {
  Eigen::MatrixXd columns;
  Eigen::VectorXd growth;

  // All with the same growth.
  static Sites At(Eigen::MatrixXd columns, double growth) {
    const Eigen::Index count = columns.cols();
    return {std::move(columns), Eigen::VectorXd::Constant(count, growth)};
  }
};

class CovarianceRows;

// What the covariance of one pair is made of.
struct PairTerms {
  double p = 0;
  double q = 0;
  Correlation rho = {};              // at q
  double target_share = 1;           // e^(-a (g + g'))
  double shared_growth = 0;          // g g' + (g² - g)(g'² - g')
  Correlation discrepancy_rho = {};  // at q/λ²
};

class Covariance {
 public:
  Covariance(Kernel kernel, Hyperparameters hyper);

  // `a` and `b` point to the coordinates; `growth_a` and `growth_b` are g of each.
  PairTerms Terms(const double* a, const double* b, double growth_a, double growth_b) const;
  double Value(const PairTerms& terms) const;
  // The part that is the target's, but for the constant.
  double TargetValue(const PairTerms& terms) const;

  double At(const double* a, const double* b, double growth_a = 0, double growth_b = 0) const {
    return Value(Terms(a, b, growth_a, growth_b));
  }
  // `At` of all pairs, to the bit.
  Eigen::MatrixXd Between(const Sites& a, const Sites& b) const;
  Eigen::MatrixXd Among(const Sites& sites) const;  // `Between` of them and themselves
  Eigen::VectorXd Diagonal(const Sites& sites) const;

  // ∂k(x, b_j)/∂x of x at the target, one column for each column b_j of `b`.
  Eigen::MatrixXd Gradient(const Eigen::VectorXd& x, const Sites& b) const;
  Eigen::VectorXd DiagonalGradient(const Eigen::VectorXd& x) const;  // d k(x, x) / dx

  const Hyperparameters& hyper() const { return hyper_; }

 private:
  // Covariances of the last `count` rows with the point `b`.
  Eigen::ArrayXd Column(const CovarianceRows& rows, Eigen::Index count, const double* b,
                        double growth) const;

  Kernel kernel_;
  Hyperparameters hyper_;
};

}  // namespace talus::surrogate
