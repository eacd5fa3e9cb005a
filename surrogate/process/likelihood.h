// How probable the values are under a Gaussian process, as a function of its hyper-parameters, with
// the analytic gradient.
//
//   L = -½ yᵀ K⁻¹ y - ½ ln|K| - (u/2) ln 2π - ½ [(N - u) ln(2π n²) + S/n² + Σ ln mᵢ]
//   dL/dθ = ½ tr((α αᵀ - K⁻¹) dK/dθ) + …,   α = K⁻¹ y,   K = k(X, X) + n² diag(1/mᵢ)
//
// The bracket is what pooling N values into u points leaves; S is PooledData::sum_of_squares
// (replicates.h). θ are logarithms of the hyper-parameters, but warp strengths themselves; the
// prior is normal in θ.
#pragma once

#include <Eigen/Core>

#include "surrogate/process/covariance.h"
#include "surrogate/process/replicates.h"

namespace talus::surrogate {

struct LogNormal {
  double median = 1;
  double log_sd = 1;  // standard deviation of the logarithm
};

// Values are scaled to standard deviation 1, points to the unit cube, so these mean the same for
// every problem.
struct HyperPriors {
  LogNormal length{.median = 0.7, .log_sd = 0.7};
  LogNormal signal{.median = 1.0, .log_sd = 0.7};
  LogNormal trend{.median = 0.5, .log_sd = 1.0};
  LogNormal noise{.median = 0.1, .log_sd = 1.0};
  double warp_sd = 1.0;  // warp strengths are normal about 0
};

// Which hyper-parameters are free, and how they map to θ = (ln ℓ…, ln s, [ln t], [ln n], [warp]).
struct HyperLayout {
  Eigen::Index dimension = 0;
  bool free_trend = false;  // else t = 0
  bool free_noise = false;  // else n = fixed_noise
  double fixed_noise = 0;
  bool free_warp = false;  // else none

  Eigen::Index size() const { return warp_index() + (free_warp ? dimension : 0); }
  Eigen::Index trend_index() const { return dimension + 1; }
  Eigen::Index noise_index() const { return dimension + 1 + (free_trend ? 1 : 0); }
  Eigen::Index warp_index() const { return noise_index() + (free_noise ? 1 : 0); }
  Hyperparameters Unpack(const Eigen::VectorXd& theta) const;
  Eigen::VectorXd Pack(const Hyperparameters& hyper) const;
};

// K = k(X, X) + n² diag(1/m), of points warped already.
Eigen::MatrixXd NoisyCovariance(const Covariance& covariance, const PooledData& data);

// What pooling leaves of the likelihood, the bracket above: a function of the noise alone.
double PoolingTerm(const PooledData& data, double noise_variance);

// L alone; `gradient`, where not null, gets dL/dθ. Minus infinity where K is not positive definite.
double LogLikelihood(const PooledData& raw, Kernel kernel, const HyperLayout& layout,
                     const Eigen::VectorXd& theta, Eigen::VectorXd* gradient);

// The logarithm of the prior's density of θ; the gradient is added to `gradient` where not null.
double LogPrior(const HyperPriors& priors, const HyperLayout& layout, const Eigen::VectorXd& theta,
                Eigen::VectorXd* gradient);

// θ at the medians of the prior, and its standard deviations.
Eigen::VectorXd PriorMedian(const HyperPriors& priors, const HyperLayout& layout);
Eigen::VectorXd PriorSd(const HyperPriors& priors, const HyperLayout& layout);

}  // namespace talus::surrogate
