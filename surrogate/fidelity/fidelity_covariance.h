// The prior covariance of an output that is simulated at several scale factors: what it is at the
// target, and a discrepancy that grows from zero there.
//
//   z(x, f) = e^(-a g) z(x) + g d₁(x) + (g² - g) d₂(x) + noise
//   g = (f - f_target)/(f_coarsest - f_target)
//
//   cov z  = c² + t² (p + p²) + s² ρ(q)           as for one scale factor (covariance.h)
//   cov d₁ = cov d₂ = u² (1 + p/2 + ρ(q/λ²))      p, q, ρ as above; e^(-a g) leaves c² as it is
//
// A noisy linear autoregressive model [kennedy2000] with coefficient e^(-a g), written as one
// process with the scale factor as input, so that designs need not be nested. A large a says that
// coarse evaluations tell nothing of the target. d₂ vanishes at the target and at the coarsest
// scale factor: it says how far the growth may be from linear. One evaluation at scale factor l has
// noise sd n_l.
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
  double decay = 0;          // a
  double length_ratio = 1;   // λ
};

// Logarithms of all but the warps and the decay, in the order of FidelityHyper.
struct FidelityLayout {
  Eigen::Index dimension = 0;
  Eigen::Index num_levels = 1;

  Eigen::Index signal() const { return dimension; }
  Eigen::Index trend() const { return dimension + 1; }
  Eigen::Index discrepancy() const { return dimension + 2; }
  Eigen::Index noise() const { return dimension + 3; }
  Eigen::Index warp() const { return dimension + 3 + num_levels; }
  Eigen::Index decay() const { return 2 * dimension + 3 + num_levels; }
  Eigen::Index length_ratio() const { return 2 * dimension + 4 + num_levels; }
  Eigen::Index size() const { return 2 * dimension + 5 + num_levels; }

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
  Correlation rho;  // at q

  static FidelityPair Of(const FidelityHyper& hyper, const double* a, const double* b);
};

// Of the outputs at two points whose discrepancies have grown by g1 and g2; 0 is the target.
double FidelityCovarianceOf(const FidelityHyper& hyper, const FidelityPair& pair, double g1,
                            double g2);

// ln p(values | θ) + ln p(θ); `gradient`, where not null, gets the derivative by θ. θ has a normal
// prior of mean `median` and standard deviations `sd`. Minus infinity where K is indefinite.
double FidelityLogPosterior(const FidelityData& data, const FidelityLayout& layout,
                            const Eigen::VectorXd& median, const Eigen::VectorXd& sd,
                            const Eigen::VectorXd& theta, Eigen::VectorXd* gradient);

}  // namespace talus::surrogate
