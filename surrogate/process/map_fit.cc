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

// The box of the search, in standard deviations of the prior: wide, but where exp(θ) and the
// factorisation stay sound.
constexpr double kMostSds = 4;
constexpr double kLargestWarp = 5;  // e^5: one end is stretched 150 times as much as the other

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

SearchTask BoxOf(const HyperLayout& layout, const ThetaPrior& prior) {
  SearchTask task{.algorithm = SearchAlgorithm::kLbfgs,
                  .lower = prior.median - kMostSds * prior.sd,
                  .upper = prior.median + kMostSds * prior.sd};
  if (layout.free_warp) {
    task.lower.segment(layout.warp(), layout.dimension).setConstant(-kLargestWarp);
    task.upper.segment(layout.warp(), layout.dimension).setConstant(kLargestWarp);
  }
  return task;
}

// Where evaluations at coarse scale factors tell nothing of the target. A search that starts from
// the prior's median ends in another maximum then: it takes them for a rough output without noise.
Eigen::VectorXd UselessLevels(const HyperLayout& layout, const ThetaPrior& prior) {
  Hyperparameters hyper = layout.Unpack(prior.median);
  hyper.scale = ScaleTerm{.discrepancy = 0.5, .decay = 3, .length_ratio = 0.4};
  hyper.noise.head(layout.num_levels - 1).setConstant(0.7);
  return layout.Pack(hyper);
}

std::vector<Eigen::VectorXd> StartPoints(const HyperLayout& layout, const ThetaPrior& prior,
                                         const GaussianProcessOptions& options) {
  std::vector<Eigen::VectorXd> thetas;
  if (options.start) thetas.push_back(layout.Pack(*options.start));
  if (thetas.empty() || options.effort.num_starts > 1) thetas.push_back(prior.median);
  for (int i = 0; static_cast<int>(thetas.size()) < options.effort.num_starts; ++i) {
    base::Random random(options.seed, base::Stream("hyper-parameter starts"),
                        static_cast<std::uint64_t>(i));
    Eigen::VectorXd theta = prior.median;
    for (Eigen::Index k = 0; k < theta.size(); ++k) theta[k] += prior.sd[k] * random.Normal();
    thetas.push_back(theta);
  }
  if (layout.has_scale && layout.num_levels > 1) thetas.push_back(UselessLevels(layout, prior));
  return thetas;
}

// Best first.
std::vector<Start> Rated(const std::vector<Eigen::VectorXd>& thetas, const SearchFunction& cost,
                         const SearchTask& task, double work) {
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
PooledData Thinned(const PooledData& all) {
  const Eigen::Index size = all.size();
  if (size <= kMostPoints) return all;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < kMostPoints; ++i) kept.push_back(i * size / kMostPoints);
  PooledData few = all;
  few.sites = {all.sites.columns(Eigen::all, kept), all.sites.growth(kept)};
  few.level = all.level(kept);
  few.values = all.values(kept);
  few.counts = all.counts(kept);
  few.first = all.first(kept);
  return few;
}

}  // namespace

MapFit FitHyperparameters(const PooledData& all, const HyperLayout& layout,
                          const GaussianProcessOptions& options) {
  const FitEffort& effort = options.effort;
  const PooledData data = effort.may_thin ? Thinned(all) : all;
  const ThetaPrior prior(options.priors, layout);
  const SearchFunction cost = [&](const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) {
    double posterior = LogLikelihood(data, options.kernel, layout, theta, gradient);
    if (!std::isfinite(posterior)) return -posterior;
    posterior += prior.LogDensity(theta, gradient);
    if (gradient != nullptr) *gradient *= -1;
    return -posterior;
  };
  SearchTask task = BoxOf(layout, prior);
  const bool many = effort.may_thin && data.size() > kManyPoints;
  task.max_evaluations =
      many ? std::min(effort.max_evaluations, kShortSearch) : effort.max_evaluations;
  task.relative_tolerance = effort.relative_tolerance;
  const auto size = static_cast<double>(data.size());
  const double work = size * size * (size / 3 + 20);  // of one likelihood
  const std::vector<Start> starts = Rated(StartPoints(layout, prior, options), cost, task, work);
  const int num_searches =
      std::min<int>(many ? 1 : effort.num_searches, static_cast<int>(starts.size()));
  std::vector<Minimum> found(static_cast<std::size_t>(num_searches));
  base::ParallelFor({.num_items = num_searches, .item_work = task.max_evaluations * work},
                    [&](std::int64_t i) {
                      const auto k = static_cast<std::size_t>(i);
                      SearchTask own = task;
                      own.start = starts[k].theta;
                      found[k] = Minimize(cost, own);
                    });
  Start best = starts.front();
  for (const Minimum& one : found) {
    if (one.value < best.cost) best = {one.point, one.value};
  }
  return {.theta = best.theta,
          .log_prior = prior.LogDensity(best.theta, nullptr) + prior.LogConstant()};
}

}  // namespace talus::surrogate
