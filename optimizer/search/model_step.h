// The searches on a model of the objective that decide the next evaluation, the recommendation and
// the end. Serve every ObjectiveModel, of numbers or of images.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "optimizer/search/feasibility.h"
#include "optimizer/search/model_search.h"
#include "optimizer/search/objective_model.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// Posterior standard deviations between a bound and the mean, in the rule that ends a search.
inline constexpr double kBoundSds = 1.96;

// Where the minima of posterior draws are looked for.
struct MinimiserSearch {
  int num_draws = 64;
  int num_even = 200;  // candidates over the cube
  int num_near = 200;  // and near the best points
};

// How thoroughly each of the searches looks; their seeds are the view's.
struct StepSearches {
  SearchOptions improvement = {};
  SearchOptions mean = {.num_local = 6};
  SearchOptions bound = {};
  MinimiserSearch minimisers = {};  // knowledge_gradient.h
};

struct ModelView {
  const ObjectiveModel& model;
  const Feasibility& feasibility;
  const Domain& domain;
  const Eigen::MatrixXd&
      points;               // evaluated, one a row, at least one: searches start near the best
  double failure_cost = 0;  // what a likely failure adds to the mean, in units of the model
  StepSearches searches = {};
  std::uint64_t seed = 1;
};

// What is to be improved on.
struct Incumbent {
  double value = 0;
  double noise = 0;  // noise sd of one evaluation; 0 when deterministic
  // For lists. Each point is evaluated once and its own value counts, chance included: improvement
  // is expected of that, not of the mean over its surroundings.
  bool is_own_value = false;
};

// The evaluated points of the lowest posterior mean, the lowest first, at most five.
Eigen::MatrixXd BestEvaluated(const ModelView& view);

// The point of the largest expected improvement on the incumbent, weighted by the probability that
// the evaluation works and, where noise > 0, by what one noisy evaluation would teach. The search
// starts near `centers`, one a row.
Eigen::VectorXd MostExpectedImprovement(const ModelView& view, const Incumbent& incumbent,
                                        const Eigen::MatrixXd& centers);

// The minimiser of the posterior mean over the domain, where evaluations are likely to work. The
// search starts near `centers`, one a row; by default the best evaluated points.
Eigen::VectorXd LowestMean(const ModelView& view);
Eigen::VectorXd LowestMean(const ModelView& view, const Eigen::MatrixXd& centers);

// The lowest posterior mean - kBoundSds posterior standard deviations over the domain, less where
// evaluations more probably fail than work. The search starts near `centers`, one a row, at least
// one.
double LowestBound(const ModelView& view, const Eigen::MatrixXd& centers);

}  // namespace talus::optimizer
