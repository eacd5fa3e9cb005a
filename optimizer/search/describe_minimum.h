// What a model of the objective says of its minimum: how well each parameter is known, what ties
// with it, and which parameters matter. Serves every ObjectiveModel, scalar or field.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "optimizer/answer.h"
#include "optimizer/search/feasibility.h"
#include "optimizer/search/objective_model.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct AnswerOptions {
  int num_candidates = 4000;      // over the cube, > 0
  int num_draw_candidates = 400;  // plausible ones, at which draws are minimised, > 1
  int num_draws = 400;            // posterior draws, > 1
  int num_sobol = 512;            // base sample of the Sobol indices, > 1
  std::uint64_t seed = 1;
  // Points that fail with a probability above 0.5 are left out; null: none.
  const Feasibility* feasibility = nullptr;
};

// `point` is the minimiser of the posterior mean. Fills everything but Answer::model.
Answer DescribeMinimum(const ObjectiveModel& model, const Domain& domain,
                       const Eigen::VectorXd& point, const AnswerOptions& options);

// Warnings of coordinates within 0.5 % of an end of their range.
std::vector<BoundWarning> BoundWarnings(const Eigen::VectorXd& point);

// The same in words: of a campaign's answer and of a plain search's.
std::string BoundText(const std::string& parameter, bool is_upper, bool has_levels = false);

}  // namespace talus::optimizer
