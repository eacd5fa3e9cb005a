// A weighted sample of a density on the unit cube, by importance sampling from an even start, and
// from the prior where there is one, refined where the weights are [cappe2004]: it may be curved
// and have several branches.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "optimizer/posterior/kernel_mixture.h"
#include "optimizer/posterior/posterior_sample.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct SampledSpace {
  const Domain* domain = nullptr;
  const Prior* prior = nullptr;  // part of the density
  int num_start = 0;             // even points of the cube
};

// Points that come to serve one density after another, by what each has covered.
class ImportanceSampler {
 public:
  // Throws base::Error where the domain's constraints leave nothing.
  ImportanceSampler(const SampledSpace& space, std::uint64_t seed);

  // Adds points where a density has its weight. It is asked with all points so far, one a row, of
  // which those before keep their places.
  void Cover(const LogDensityFunction& density);

  const Eigen::MatrixXd& points() const { return points_; }
  // ln of the cube's volume that each stands for, by the balance heuristic: the proposal is the
  // mixture of all rounds.
  Eigen::VectorXd LogVolume() const;

 private:
  // A round's proposal, and how many draws are from it.
  struct Round {
    KernelMixture mixture;
    double num_draws = 0;
  };

  int Dimension() const { return static_cast<int>(space_.domain->num_parameters); }
  void AddRound(KernelMixture mixture, int num_draws);
  void TellRounds();
  void TellPrior();

  SampledSpace space_;
  int num_prior_ = 0;  // points drawn from the prior; none from a uniform one
  base::Random random_;
  double log_even_ = 0;
  Eigen::MatrixXd points_;
  std::vector<Round> rounds_;
  // Log density of each point (rows) in each round (columns), times its draws.
  Eigen::MatrixXd in_rounds_;
  Eigen::VectorXd in_prior_;  // likewise, where some are drawn from it
};

// Throws as the sampler does.
PosteriorSample SampleByImportance(const LogDensityFunction& density, const SampledSpace& space,
                                   std::uint64_t seed);

}  // namespace talus::optimizer
