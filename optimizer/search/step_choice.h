// Which kind of step to take next without noise: the one that has paid lately.
//
// Each problem, and each phase of it, has another kind that finds improvements while the others
// find none. The share of its latest steps that improved on the best value by more than a trifle is
// followed for each kind, old steps counting less and less, so that one not tried for long is tried
// again.
#pragma once

#include <Eigen/Core>

namespace talus::optimizer {

enum class Step {
  kGlobal,     // by a process of all evaluations
  kQuadratic,  // by a quadratic through the neighbours of the best one
  kLocal,      // by a process of the neighbours of the best one
};

// `values` in order of telling, the first `num_before` from before the first step. The kinds of the
// steps are not told but inferred by the same rule; `num_pending` steps under way count as vain.
Step NextStep(const Eigen::VectorXd& values, int num_before, int num_pending);

// The least gain on the best value that is one: a millionth of the spread of the first values.
double LeastGain(const Eigen::VectorXd& values, int num_before);

}  // namespace talus::optimizer
