// The answer as it would be, had every simulation shown something more: what a campaign's posterior
// makes of a shift of the outputs.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/shift_field.h"
#include "experiments/campaign/answer/joint_view.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::analysis {

struct Foretold {
  optimizer::AnswerIfShifted answer;  // unit cube
  Eigen::VectorXd standard_error;     // of its point, by chance in the last shifts; unit cube
};

class Foreteller {
 public:
  // The strategy was told the campaign's trials, and has a model.
  Foreteller(std::unique_ptr<optimizer::PosteriorStrategy> strategy, std::uint64_t seed)
      : strategy_(std::move(strategy)), seed_(seed) {}

  // More simulations without a move: the shifts to come are in outputs of the posterior after them.
  void Tell(const SimulatedSet& more);

  const optimizer::Posterior& posterior() { return strategy_->Model(); }
  optimizer::Answer Recommend() { return strategy_->Recommend(); }

  // One for each experiment that the campaign answers by.
  Foretold With(const std::vector<ShiftField>& shifts);

 private:
  std::unique_ptr<optimizer::PosteriorStrategy> strategy_;
  std::uint64_t seed_;
  Eigen::MatrixXd response_{};  // of the point to what was measured; empty: not worked out yet
};

// Told the trials of a campaign. Throws base::Error where there are too few for a posterior.
Foreteller ForetellerOf(const campaign::JointView& view);

}  // namespace talus::analysis
