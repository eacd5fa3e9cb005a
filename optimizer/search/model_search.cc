#include "optimizer/search/model_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel_for.h"
#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/ascending.h"
#include "optimizer/space/point_rows.h"
#include "surrogate/nlopt_minimize.h"

namespace talus::optimizer {
namespace {

// Half the candidates are spread evenly, half lie near the centres at distances from 1e-3 to 0.3,
// since a promising region can be that small.
Eigen::MatrixXd Candidates(const Domain& domain, const Eigen::MatrixXd& centers,
                           const SearchOptions& options) {
  const int dimension = domain.num_parameters;
  base::Random random(options.seed, base::Stream("model search"));
  const int num_even = centers.rows() > 0 ? options.num_candidates / 2 : options.num_candidates;
  Eigen::MatrixXd points(options.num_candidates, dimension);
  points.topRows(num_even) = RSequence(num_even, dimension, options.seed);
  for (int i = num_even; i < options.num_candidates; ++i) {
    const auto center = static_cast<Eigen::Index>(i) % centers.rows();
    const double radius = 0.3 * std::pow(10.0, -2.5 * random.Uniform());
    for (int k = 0; k < dimension; ++k) {
      points(i, k) = std::clamp(centers(center, k) + radius * random.Normal(), 0.0, 1.0);
    }
  }
  points = Inside(domain, points);
  return centers.rows() > 0 ? Stack(centers, points) : points;
}

// The best candidates, none within 0.02 of a better one in every coordinate, so that the local
// searches do not all climb one hill.
std::vector<Eigen::Index> Starts(const Eigen::MatrixXd& candidates, const Eigen::VectorXd& values,
                                 int count) {
  std::vector<Eigen::Index> starts;
  for (const Eigen::Index i : Ascending(values)) {
    if (static_cast<int>(starts.size()) == count) break;
    const bool near = std::any_of(starts.begin(), starts.end(), [&](Eigen::Index j) {
      return (candidates.row(i) - candidates.row(j)).lpNorm<Eigen::Infinity>() < 0.02;
    });
    if (!near) starts.push_back(i);
  }
  return starts;
}

// A simplex started small a second time gets on where the first one has collapsed at a kink.
std::vector<surrogate::SearchTask> LocalSearches(const SearchOptions& options, int dimension) {
  surrogate::SearchTask task{.algorithm = surrogate::SearchAlgorithm::kLbfgs,
                             .lower = Eigen::VectorXd::Zero(dimension),
                             .upper = Eigen::VectorXd::Ones(dimension),
                             .start = {},
                             .max_evaluations = options.max_evaluations,
                             .absolute_tolerance = options.tolerance};
  if (!options.kinked) return {task};
  task.algorithm = surrogate::SearchAlgorithm::kNelderMead;
  task.initial_step = 0.05;
  std::vector<surrogate::SearchTask> tasks{task, task};
  tasks[1].initial_step = 0.005;
  return tasks;
}

Found Climb(const surrogate::SearchFunction& function, const Domain& domain,
            const Eigen::VectorXd& start, const SearchOptions& options) {
  Found best{{}, std::numeric_limits<double>::infinity()};
  Eigen::VectorXd from = start;
  for (surrogate::SearchTask& task : LocalSearches(options, domain.num_parameters)) {
    task.start = from;
    const surrogate::Minimum found = surrogate::Minimize(function, task);
    from = found.point;
    if (found.value < best.value || best.point.size() == 0) {
      best = {domain.levels.empty() ? found.point : domain.Snap(found.point), found.value};
    }
  }
  return best;
}

Found BestOfList(const CheapFunction& function, const Domain& domain) {
  const Eigen::VectorXd values = function.values(domain.candidates);
  Eigen::Index best = 0;
  const double value = values.minCoeff(&best);
  return {domain.candidates.row(best), value};
}

}  // namespace

Found SearchCube(const CheapFunction& function, const Domain& domain,
                 const Eigen::MatrixXd& centers, const SearchOptions& options) {
  if (domain.IsList()) return BestOfList(function, domain);
  const Eigen::MatrixXd candidates = Candidates(domain, centers, options);
  const Eigen::VectorXd values = function.values(candidates);
  const auto inside = [&](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
    if (!domain.Contains(x)) return std::numeric_limits<double>::infinity();
    return function.value_and_gradient(x, gradient);
  };
  const auto at_levels = [&](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
    const double value = inside(domain.Snap(x), gradient);
    for (Eigen::Index k = 0; gradient != nullptr && k < gradient->size(); ++k) {
      if (domain.HasLevels(k)) (*gradient)[k] = 0;  // the search moves the other coordinates
    }
    return value;
  };
  const surrogate::SearchFunction whole =
      domain.levels.empty() ? surrogate::SearchFunction(inside) : at_levels;
  const std::vector<Eigen::Index> starts = Starts(candidates, values, options.num_local);
  std::vector<Found> found(starts.size());
  base::ParallelFor({.num_items = static_cast<std::int64_t>(starts.size()),
                     .item_work = options.max_evaluations * function.work},
                    [&](std::int64_t i) {
                      const auto k = static_cast<std::size_t>(i);
                      found[k] = Climb(whole, domain, candidates.row(starts[k]), options);
                    });
  return *std::min_element(found.begin(), found.end(),
                           [](const Found& a, const Found& b) { return a.value < b.value; });
}

}  // namespace talus::optimizer
