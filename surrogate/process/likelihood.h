// How probable the values are under a Gaussian process, as a function of its hyper-parameters, with
// the analytic gradient.
//
//   L = -½ yᵀ K⁻¹ y - ½ ln|K| - ½ Σ_l [(N_l - u_l) ln n_l² + S_l/n_l²] - ½ Σ ln mᵢ - (N/2) ln 2π
//   dL/dθ = ½ tr((α αᵀ - K⁻¹) dK/dθ) + …,   α = K⁻¹ y,   K = k(X, X) + diag(n_l²/mᵢ)
//
// The brackets are what pooling N_l values of scale factor l into u_l points leaves (replicates.h).
// θ are logarithms of the hyper-parameters, but warp strengths and the decay themselves; the prior
// is normal in θ.
#pragma once

#include <Eigen/Core>

#include "surrogate/process/covariance.h"
#include "surrogate/process/replicates.h"

namespace talus::surrogate {

// Which hyper-parameters are free, and how they map to
// θ = (ln ℓ…, ln s, [ln t], [ln u], [ln n…], [warp…], [a, ln λ]).
struct HyperLayout {
  Eigen::Index dimension = 0;
  Eigen::Index num_levels = 1;  // scale factors
  bool free_trend = false;      // else t = 0
  bool free_noise = false;      // else n = fixed_noise
  double fixed_noise = 0;
  bool free_warp = false;  // else none
  bool has_scale = false;  // else no discrepancy

  Eigen::Index signal() const { return dimension; }
  Eigen::Index trend() const { return dimension + 1; }
  Eigen::Index discrepancy() const { return trend() + (free_trend ? 1 : 0); }
  Eigen::Index noise() const { return discrepancy() + (has_scale ? 1 : 0); }
  Eigen::Index warp() const { return noise() + (free_noise ? num_levels : 0); }
  Eigen::Index decay() const { return warp() + (free_warp ? dimension : 0); }
  Eigen::Index length_ratio() const { return decay() + 1; }
  Eigen::Index size() const { return decay() + (has_scale ? 2 : 0); }

  Hyperparameters Unpack(const Eigen::VectorXd& theta) const;
  Eigen::VectorXd Pack(const Hyperparameters& hyper) const;
};

// K of sites that are warped already. `nugget` is added to each element of the diagonal.
Eigen::MatrixXd NoisyCovariance(const Covariance& covariance, const PooledData& data,
                                double nugget = 0);

// What pooling leaves of the likelihood, the brackets above: a function of the noise alone.
double PoolingTerm(const PooledData& data, const Eigen::VectorXd& noise);

// L but for its last term, which is a constant; `gradient`, where not null, gets dL/dθ. Minus
// infinity where K is not positive definite.
double LogLikelihood(const PooledData& raw, Kernel kernel, const HyperLayout& layout,
                     const Eigen::VectorXd& theta, Eigen::VectorXd* gradient);

// The normal prior of θ.
struct ThetaPrior {
  Eigen::VectorXd median;
  Eigen::VectorXd sd;

  ThetaPrior(const HyperPriors& priors, const HyperLayout& layout);

  // The logarithm of its density but for a constant; the gradient is added to `gradient` where not
  // null.
  double LogDensity(const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) const;
  double LogConstant() const;  // that constant
};

}  // namespace talus::surrogate
