#include "surrogate/process/map_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel_for.h"
#include "base/random.h"
#include "surrogate/nlopt_minimize.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::surrogate {
namespace {

constexpr double kLargestBend = 5;  // e^5: one end is stretched 150 times as much as the other

// So many points leave the posterior one maximum worth finding, and each step of a search costs the
// cube of their number: one search, and a shorter one.
constexpr Eigen::Index kManyPoints = 100;
constexpr int kShortSearch = 40;
// And so many decide the hyper-parameters, of which there are ten at most: all of 1000 would cost
// 125 times as much.
constexpr Eigen::Index kMostPoints = 200;

struct Start {
  Eigen::VectorXd theta;
  double cost = 0;  // minus the log posterior
};

// The box of the search: wide, but where exp(θ) and the factorisation stay sound.
void SetBounds(const HyperLayout& layout, double noise_floor, SearchTask& task) {
  task.lower = Eigen::VectorXd::Constant(layout.size(), std::log(1e-3));
  task.upper = Eigen::VectorXd::Constant(layout.size(), std::log(1e2));
  task.lower.head(layout.dimension).setConstant(std::log(0.02));
  task.upper.head(layout.dimension).setConstant(std::log(50.0));
  if (layout.free_noise) {
    task.lower[layout.noise_index()] = 0.5 * std::log(noise_floor);
    task.upper[layout.noise_index()] = std::log(3.0);
  }
  if (layout.free_warp) {
    task.lower.tail(layout.dimension).setConstant(-kLargestBend);
    task.upper.tail(layout.dimension).setConstant(kLargestBend);
  }
}

std::vector<Start> TrialStarts(const SearchFunction& cost, const SearchTask& task,
                               const HyperLayout& layout, const GaussianProcessOptions& options,
                               double work) {
  const Eigen::VectorXd median = PriorMedian(options.priors, layout);
  std::vector<Eigen::VectorXd> thetas;
  if (options.start) thetas.push_back(layout.Pack(*options.start));
  if (thetas.empty() || options.num_trial_starts > 1) thetas.push_back(median);
  const Eigen::VectorXd sd = PriorSd(options.priors, layout);
  for (int i = 0; static_cast<int>(thetas.size()) < options.num_trial_starts; ++i) {
    base::Random random(options.seed, base::Stream("hyper-parameter starts"),
                        static_cast<std::uint64_t>(i));
    Eigen::VectorXd theta = median;
    for (Eigen::Index k = 0; k < theta.size(); ++k) theta[k] += sd[k] * random.Normal();
    thetas.push_back(theta);
  }
  std::vector<Start> starts(thetas.size());
  base::ParallelFor({.num_items = static_cast<std::int64_t>(thetas.size()), .item_work = work},
                    [&](std::int64_t i) {
                      const auto k = static_cast<std::size_t>(i);
                      starts[k].theta = thetas[k].cwiseMax(task.lower).cwiseMin(task.upper);
                      starts[k].cost = cost(starts[k].theta, nullptr);
                    });
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.cost < b.cost; });
  return starts;
}

// At most kMostPoints, evenly through the order in which they were evaluated. What all replicates
// say of the noise is kept.
PooledData FewOf(const PooledData& all) {
  const Eigen::Index size = all.values.size();
  if (size <= kMostPoints) return all;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < kMostPoints; ++i) kept.push_back(i * size / kMostPoints);
  return {.points = all.points(Eigen::all, kept),
          .values = all.values(kept),
          .counts = all.counts(kept),
          .sum_of_squares = all.sum_of_squares,
          .num_values = all.num_values - static_cast<int>(size - kMostPoints)};
}

}  // namespace

MapFit FitHyperparameters(const PooledData& all, const HyperLayout& layout,
                          const GaussianProcessOptions& options) {
  const PooledData data = FewOf(all);
  const SearchFunction cost = [&](const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) {
    double posterior = LogLikelihood(data, options.kernel, layout, theta, gradient);
    if (!std::isfinite(posterior)) return -posterior;
    posterior += LogPrior(options.priors, layout, theta, gradient);
    if (gradient != nullptr) *gradient *= -1;
    return -posterior;
  };
  SearchTask task{.algorithm = SearchAlgorithm::kLbfgs,
                  .lower = {},
                  .upper = {},
                  .start = {},
                  .max_evaluations = options.max_evaluations,
                  .relative_tolerance = 1e-7};
  SetBounds(layout, options.noise_floor, task);
  const auto size = static_cast<double>(data.values.size());
  const double work = size * size * (size / 3 + 20);  // of one likelihood
  const std::vector<Start> starts = TrialStarts(cost, task, layout, options, work);
  Start best = starts.front();
  const bool many = data.values.size() > kManyPoints;
  if (many) task.max_evaluations = std::min(task.max_evaluations, kShortSearch);
  const int num_searches =
      std::min<int>(many ? 1 : options.num_starts, static_cast<int>(starts.size()));
  std::vector<Minimum> found(static_cast<std::size_t>(num_searches));
  base::ParallelFor({.num_items = num_searches, .item_work = task.max_evaluations * work},
                    [&](std::int64_t i) {
                      const auto k = static_cast<std::size_t>(i);
                      SearchTask own = task;
                      own.start = starts[k].theta;
                      found[k] = Minimize(cost, own);
                    });
  for (const Minimum& one : found) {
    if (one.value < best.cost) best = {one.point, one.value};
  }
  return {.theta = best.theta, .log_prior = LogPrior(options.priors, layout, best.theta, nullptr)};
}

}  // namespace talus::surrogate
