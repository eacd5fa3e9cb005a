// The posterior of the parameters: how likely the measured outputs of all experiments are at a set.
//
//   ln p(x | data) = -Σ ln sₖ(x) - ½ ρ(M(x)/T) + const,   M = rᵀ R⁻¹ r          joint_misfit.h
//
// r residuals of the K outputs in standard deviations s (experiment_model.h: the experiment's own
// error, model error and the surrogate's, which is inflated in r and not in -Σ ln s). R and T come
// from leave-one-out residuals of all experiments together, so that two tests are not added as if
// independent. The prior is uniform over the domain.
//
// An experiment of weight w counts as its likelihood to the power w: √w r and w ln s.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "optimizer/posterior/experiment_model.h"
#include "optimizer/posterior/joint_misfit.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// A weighted sample of the posterior.
struct PosteriorSample {
  Eigen::MatrixXd points;         // one a row
  Eigen::VectorXd log_density;    // of each, up to a constant
  Eigen::VectorXd weight;         // of each, for expectations under the posterior; sums to 1
  Eigen::VectorXd volume;         // of each, for integrals over the cube; sums to about 1
  double region_log_density = 0;  // at the edge of the joint 90 % region

  // Share of the posterior where the density is higher than this.
  double CredibleLevel(double log_density) const;
  double RegionVolume() const;
  // Equally likely draws.
  Eigen::MatrixXd Draws(int count, std::uint64_t seed) const;
};

class Posterior {
 public:
  // One model an experiment; `places` groups evaluations of different experiments at one
  // set and scale factor (see posterior.cc).
  Posterior(std::vector<ExperimentModel> models, const std::vector<OutputData>& data);

  // Up to a constant, one point a row. `softness` >= 1 divides the misfits once more, for
  // exploration.
  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points, double softness = 1) const;
  // The same from the outputs there, one element an experiment.
  Eigen::VectorXd LogDensity(const std::vector<OutputMoments>& outputs, double softness = 1) const;
  std::vector<OutputMoments> Outputs(const Eigen::MatrixXd& points) const;

  // By importance sampling from an even start, refined where the weights are [cappe2004]: the
  // posterior may be curved and have several branches.
  PosteriorSample Sample(const Domain& domain, int num_start, double softness,
                         std::uint64_t seed) const;

  // Misfit of an experiment over √T at x [standard deviations].
  double Implausibility(std::size_t experiment, const Eigen::VectorXd& x) const;
  // Σ r² of an experiment over T, one point a row, without the surrogate's caution.
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
};

}  // namespace talus::optimizer
