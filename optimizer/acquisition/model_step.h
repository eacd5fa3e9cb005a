// The searches on a model of the objective that decide the next evaluation, the recommendation and
// the end. Serve every ObjectiveModel.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "optimizer/models/feasibility.h"
#include "optimizer/models/objective_model.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct ModelView {
  const ObjectiveModel& model;
  const Feasibility& feasibility;
  const Domain& domain;
  const Eigen::MatrixXd&
      points;  // evaluated, one a row, at least one: searches start near the best
  std::uint64_t seed = 1;
};

// The point of the largest expected improvement on `incumbent`, weighted by the probability that
// the evaluation works and, where noise > 0, by what one evaluation with that scatter would teach.
Eigen::VectorXd MostExpectedImprovement(const ModelView& view, double incumbent, double noise);

// The minimiser of the posterior mean over the domain.
Eigen::VectorXd LowestMean(const ModelView& view);

// The lowest posterior mean - num_sds posterior standard deviations over the domain.
double LowestBound(const ModelView& view, double num_sds);

}  // namespace talus::optimizer
