#include "optimizer/search/local_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "optimizer/search/acquisition.h"
#include "optimizer/search/model_search.h"
#include "optimizer/search/neighbours.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {
namespace {

struct LocalFit {
  std::optional<surrogate::GaussianProcess> process;  // of coordinates as FitNeighbours says
  double incumbent = 0;                               // least of the fitted and fantasised values
  double log_posterior = -std::numeric_limits<double>::infinity();
};

// Replaces `best` where a process of these values is more probable. `log_jacobian` makes it a
// density of the objective's own values.
void TryValues(const Eigen::MatrixXd& points, const Eigen::VectorXd& values, double log_jacobian,
               std::uint64_t seed, LocalFit& best) {
  for (const auto kernel : {surrogate::Kernel::kMatern52, surrogate::Kernel::kSquaredExponential}) {
    auto process = surrogate::GaussianProcess::Fit({.points = points, .values = values},
                                                   {.kernel = kernel,
                                                    .trend = surrogate::Trend::kQuadratic,
                                                    .deterministic = true,
                                                    .effort = {.num_starts = 3, .num_searches = 1},
                                                    .seed = seed});
    const double log_posterior = process.LogPosterior() + log_jacobian;
    if (best.process && log_posterior <= best.log_posterior) continue;
    best = {std::move(process), values.minCoeff(), log_posterior};
  }
}

// In coordinates in which the ball of the neighbours touches the faces of the unit cube.
LocalFit FitNeighbours(const History& history, const Neighbours& near, std::uint64_t seed) {
  const auto size = static_cast<Eigen::Index>(near.others.size()) + 1;
  Eigen::MatrixXd points = Eigen::MatrixXd::Constant(size, history.points.cols(), 0.5);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(size, history.values[near.best]);
  for (Eigen::Index r = 1; r < size; ++r) {
    const Eigen::Index i = near.others[static_cast<std::size_t>(r - 1)];
    points.row(r) +=
        (history.points.row(i) - near.middle.transpose()) / (2 * near.distances.back());
    values[r] = history.values[i];
  }
  LocalFit best;
  TryValues(points, values, 0, seed, best);
  if (values.minCoeff() > 0) {
    TryValues(points, values.cwiseAbs2(), (2 * values.array()).log().sum(), seed, best);
  }
  return best;
}

// Adds pending points in the process's cube at their predicted means. The incumbent follows, or the
// next step would land beside the most promising of them. Predictions farther off mean nothing.
void AddFantasies(std::span<const Eigen::VectorXd> pending, const Neighbours& near, LocalFit& fit) {
  const double radius = near.distances.back();
  for (const Eigen::VectorXd& point : pending) {
    if ((point - near.middle).lpNorm<Eigen::Infinity>() > radius) continue;
    const Eigen::VectorXd u = ((point - near.middle) / (2 * radius)).array() + 0.5;
    fit.incumbent = std::min(fit.incumbent, fit.process->AddFantasy({.x = u}));
  }
}

// Minus the logarithm of the expected improvement, of the region stretched to the unit cube;
// `share` is its part of the process's cube.
CheapFunction NegativeImprovement(const LocalFit& fit, double share) {
  const auto score = [&fit](double mean, double variance) {
    return LogExpectedImprovement(mean, std::sqrt(variance), fit.incumbent);
  };
  const auto values = [&fit, score, share](const Eigen::MatrixXd& u) {
    const surrogate::Predictions at = fit.process->PredictAll((share * (u.array() - 0.5)) + 0.5);
    Eigen::VectorXd result(u.rows());
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      result[i] = -score(at.mean[i], at.variance[i]).value;
    return result;
  };
  const auto value_and_gradient = [&fit, score, share](const Eigen::VectorXd& u,
                                                       Eigen::VectorXd* gradient) {
    const auto at = fit.process->PredictWithGradient((share * (u.array() - 0.5)) + 0.5);
    const Acquisition acquisition = score(at.value.mean, at.value.variance);
    if (gradient != nullptr) {
      *gradient = -share * acquisition.mean_slope * at.mean;
      if (at.value.variance > 0) {
        *gradient -=
            share * acquisition.sd_slope * at.variance / (2 * std::sqrt(at.value.variance));
      }
    }
    return -acquisition.value;
  };
  return {values, value_and_gradient};
}

}  // namespace

std::optional<Eigen::VectorXd> LocalStep(const History& history, const Domain& domain,
                                         std::span<const Eigen::VectorXd> pending,
                                         std::uint64_t seed) {
  const auto dimension = static_cast<int>(history.points.cols());
  const Neighbours near = NeighboursOfBest(history, 10 * dimension - 1);
  if (static_cast<int>(near.others.size()) < dimension + 1) return std::nullopt;
  const double reach = near.DistanceOf(2 * dimension - 1);
  const auto to_cube = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return near.middle + reach * (2 * u.array() - 1).matrix();
  };
  const Domain region{.num_parameters = dimension, .feasible = [&](const Eigen::VectorXd& u) {
                        return domain.Contains(to_cube(u));
                      }};
  LocalFit fit = FitNeighbours(history, near, seed);
  AddFantasies(pending, near, fit);
  const Eigen::VectorXd found =
      SearchCube(NegativeImprovement(fit, reach / near.distances.back()), region,
                 Eigen::MatrixXd::Constant(1, dimension, 0.5), {.seed = seed})
          .point;
  return to_cube(found);
}

}  // namespace talus::optimizer
