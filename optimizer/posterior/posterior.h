// The posterior of the parameters: how likely the measured outputs of all experiments are at a set.
//
//   ln p(x | data) = ln p(x) - Σ ln sₖ(x) - ½ ρ(M(x)/T) + Σ ln πⱼ(x) + const,
//   M = rᵀ R⁻¹ r  joint_misfit.h
//
// r residuals of the K outputs in standard deviations s (experiment_model.h: the experiment's own
// error, model error and the surrogate's, which is inflated in r, and counts three quarters in -Σ
// ln s). R and T come from leave-one-out residuals of all experiments together, so that two tests
// are not added as if independent. The prior p(x) (prior.h) counts as it is given: T is the
// surrogates'.
//
// πⱼ(x) is the probability that a simulation of experiment j at x gives all that was measured: it
// may crash, and a drum that carries its powder round has no angle. It is 1 where every simulation
// does.
//
// An experiment of weight w counts as its likelihood to the power w: √w r and w ln s.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "optimizer/outputs/success_model.h"
#include "optimizer/posterior/experiment_model.h"
#include "optimizer/posterior/joint_misfit.h"
#include "optimizer/posterior/posterior_sample.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// How much more the simulations of an experiment show: of each output a column, one set a row.
using ShiftBySet = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& points)>;

class Posterior {
 public:
  // One model an experiment, and the evaluations it was made of; those of different experiments at
  // one set and scale factor belong together.
  Posterior(std::vector<ExperimentModel> models, const std::vector<OutputData>& data,
            Prior prior = {});

  // Up to a constant, one point a row. `softness` >= 1 divides the misfits once more, for
  // exploration.
  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points, double softness = 1) const;
  // The same from the outputs there, one element an experiment, without prior and πⱼ.
  Eigen::VectorXd LogDensity(const std::vector<OutputMoments>& outputs, double softness = 1) const;
  std::vector<OutputMoments> Outputs(const Eigen::MatrixXd& points) const;
  // From now on in the density; a shift for each experiment.
  void ShiftOutputs(std::vector<ShiftBySet> shifts) { shifts_ = std::move(shifts); }

  // Where simulations of an experiment give all that was measured; only where some do not.
  void CountSuccesses(std::size_t experiment, SuccessModel successes);
  // Σ ln πⱼ, one point a row.
  Eigen::VectorXd LogSuccess(const Eigen::MatrixXd& points) const;

  // By importance sampling from an even start, and from the prior where there is one, refined where
  // the weights are [cappe2004]: the posterior may be curved and have several branches.
  PosteriorSample Sample(const Domain& domain, int num_start, double softness,
                         std::uint64_t seed) const;

  // Misfit of an experiment over √T at x [standard deviations].
  double Implausibility(std::size_t experiment, const Eigen::VectorXd& x) const;
  // Σ r² of an experiment over T, one point a row, with no more of the surrogate's caution
  // than is due to few evaluations.
  Eigen::VectorXd SquaredMisfit(std::size_t experiment, const Eigen::MatrixXd& points) const;
  // Where each experiment stands at x.
  std::vector<ExperimentStanding> StandingsAt(const Eigen::VectorXd& x) const;

  std::vector<ExperimentModel>& models() { return models_; }
  const std::vector<ExperimentModel>& models() const { return models_; }
  double temper() const { return misfit_.temper(); }
  const LeaveOneOutCoverage& coverage() const { return misfit_.coverage(); }

 private:
  std::vector<ExperimentModel> models_;
  JointMisfit misfit_;
  Prior prior_;
  std::vector<ShiftBySet> shifts_{};  // empty: none
  struct Successes {
    double weight = 1;  // of the experiment
    SuccessModel model;
  };
  std::vector<Successes> successes_{};
};

}  // namespace talus::optimizer
