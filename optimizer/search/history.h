// What a strategy was told, as matrices for fitting.
#pragma once

#include <Eigen/Core>
#include <span>

#include "optimizer/answer.h"
#include "optimizer/observation.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct History {
  Eigen::MatrixXd points;  // n × d, one evaluation a row, in order of telling; failed ones left out
  Eigen::VectorXd values;
  Eigen::MatrixXd failed;  // failed points, one a row

  int size() const { return static_cast<int>(values.size()); }
};

History MakeHistory(std::span<const Observation> told, int num_parameters);

// What repeated points say of the noise.
struct Repeats {
  int num_repeats = 0;   // evaluations at a point evaluated before
  bool differs = false;  // one of them gave another value

  bool deterministic() const { return num_repeats > 0 && !differs; }
  // The last evaluation of `history` is new.
  void CountLast(const History& history);
};

// The answer of a strategy that has no model: the best evaluation, taken at its word. `seen` says
// in Answer::model what it is the best of.
Answer BestObserved(std::span<const Observation> told, const Domain& domain,
                    const std::string& seen);

}  // namespace talus::optimizer
