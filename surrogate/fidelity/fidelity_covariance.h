// The prior covariance of an output that is simulated at several scale factors: what it is at the
// target, and a discrepancy that grows from zero there.
//
//   z(x, f) = z(x) + g d₁(x) + (g² - g) d₂(x) + noise,       g = (f - f_target)/(f_coarsest -
//   f_target)
//
//   cov z  = c² + t² (p + p²) + s² ρ(q)                      as for one scale factor (covariance.h)
//   cov d₁ = cov d₂ = u² (1 + p/2 + ρ(q))                    p, q, ρ as above
//
// A noisy linear autoregressive model [kennedy2000] with coefficient 1, written as one process with
// the scale factor as input, so that designs need not be nested. d₂ vanishes at the target and at
// the coarsest scale factor: it says how far the growth may be from linear. One evaluation at scale
// factor l has noise sd n_l.
#pragma once

#include <Eigen/Core>

#include "surrogate/process/kernel.h"

namespace talus::surrogate {

// Standard deviations in units of the scaled values; lengths in warped coordinates.
struct FidelityHyper {
  Eigen::VectorXd length;    // ℓ, one a coordinate
  double signal = 1;         // s
  double trend = 0.5;        // t
  double discrepancy = 0.3;  // u
  Eigen::VectorXd noise;     // n_l, one a scale factor
  Eigen::VectorXd warp;      // of each coordinate (warp.h)
};

// Logarithms of all but the warps, in the order of FidelityHyper.
struct FidelityLayout {
  Eigen::Index dimension = 0;
  Eigen::Index num_levels = 1;

  Eigen::Index signal() const { return dimension; }
  Eigen::Index trend() const { return dimension + 1; }
  Eigen::Index discrepancy() const { return dimension + 2; }
  Eigen::Index noise() const { return dimension + 3; }
  Eigen::Index warp() const { return dimension + 3 + num_levels; }
  Eigen::Index size() const { return 2 * dimension + 3 + num_levels; }

  FidelityHyper Unpack(const Eigen::VectorXd& theta) const;
  Eigen::VectorXd Pack(const FidelityHyper& hyper) const;
};

// Evaluations, as columns: d × n.
struct FidelityData {
  Eigen::MatrixXd points;  // unit cube
  Eigen::VectorXd growth;  // g of each
  Eigen::VectorXi level;   // index of its scale factor
  Eigen::VectorXd values;  // scaled to mean 0, standard deviation 1
};

// One pair of points of warped coordinates.
struct FidelityPair {
  double p = 0;
  double q = 0;
  Correlation rho;

  static FidelityPair Of(const FidelityHyper& hyper, const double* a, const double* b);
};

// What the discrepancies of a pair have in common: g g' + (g² - g)(g'² - g').
inline double SharedGrowth(double a, double b) { return a * b + (a * a - a) * (b * b - b); }

double FidelityCovarianceOf(const FidelityHyper& hyper, const FidelityPair& pair, double shared);

// ln p(values | θ) + ln p(θ); `gradient`, where not null, gets the derivative by θ. θ has a normal
// prior of mean `median` and standard deviations `sd`. Minus infinity where K is indefinite.
double FidelityLogPosterior(const FidelityData& data, const FidelityLayout& layout,
                            const Eigen::VectorXd& median, const Eigen::VectorXd& sd,
                            const Eigen::VectorXd& theta, Eigen::VectorXd* gradient);

}  // namespace talus::surrogate
