// How much simulations narrow the misfit about the parameters that are asked for: what they tell of
// nuisances counts as far as these hide the others only.
//
//   gain = ½ ln det(V + B + N) - ½ ln det(V' + B + N),   N = U Uᵀ,  U = ∂z/∂n σ
//        = ½ Σ ln((V + B)/(V' + B)) + ½ ln det(I + UᵀC⁻¹U) - ½ ln det(I + UᵀC'⁻¹U),  C = V + B
//
// V and V' the surrogate's variances of the outputs z of all experiments at the target before and
// after, B what the experiments leave open; N the covariance that not knowing the nuisances n,
// whose prior has the standard deviations σ, gives the outputs at a fixed set of what is asked for.
// In the directions that nuisances explain anyhow the surrogate need not be sure. Without nuisances
// only the sum is left. An experiment of weight w counts w times: in UᵀC⁻¹U, and by what it gains
// itself, which is never negative.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/posterior/posterior.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

class AskedGain {
 public:
  // `draws` of the posterior, one a row, which gains are means over; all outlive it.
  AskedGain(const Posterior& posterior, const Domain& domain, const Eigen::MatrixXd& draws);

  // The gain by perfect knowledge at each draw (V' = 0): where something is left to learn.
  Eigen::VectorXd OfAll() const;
  // The gain by one more simulation of an experiment at a site (a row) and a level (a column).
  Eigen::MatrixXd OfOne(std::size_t experiment, const Eigen::MatrixXd& sites) const;

 private:
  // I + UᵀC⁻¹U of each draw.
  using Information = std::vector<Eigen::MatrixXd>;

  Eigen::MatrixXd EffectOf(const ExperimentModel& model, Eigen::Index nuisance) const;
  // Adds `precision`, one a draw, of an output.
  void Add(std::size_t experiment, Eigen::Index output, const Eigen::ArrayXd& precision,
           Information& information) const;
  // ½ ln det of each draw's.
  Eigen::ArrayXd HalfLogDet(const Information& information) const;

  const Posterior& posterior_;
  const Domain& domain_;
  const Eigen::MatrixXd& draws_;
  std::vector<std::vector<Eigen::MatrixXd>> effect_;  // [experiment][nuisance]: U, draws × outputs
  std::vector<Eigen::MatrixXd> variance_;             // [experiment]: V, draws × outputs
  Information information_;                           // as things are; empty without nuisances
};

}  // namespace talus::optimizer
