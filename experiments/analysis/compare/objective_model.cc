#include "experiments/analysis/compare/objective_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "base/student_factor.h"
#include "optimizer/designs/design.h"

namespace talus::analysis {
namespace {

constexpr std::size_t kMaxFitted = 150;  // points that the hyper-parameters are found from
constexpr std::size_t kMaxPoints = 300;  // points that predictions are made from

// At most `limit` of the points: half of them the nearest to `best`, the rest evenly by order.
std::vector<ModelPoint> Capped(std::span<const ModelPoint> points, const Eigen::VectorXd& best,
                               std::size_t limit) {
  if (points.size() <= limit) return {points.begin(), points.end()};
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (points[a].point - best).squaredNorm() < (points[b].point - best).squaredNorm();
  });
  const std::size_t near = limit / 2;
  std::sort(order.begin() + static_cast<std::ptrdiff_t>(near), order.end());
  std::vector<ModelPoint> kept;
  for (std::size_t i = 0; i < near; ++i) kept.push_back(points[order[i]]);
  const std::size_t rest = limit - near;
  for (std::size_t i = 0; i < rest; ++i) {
    kept.push_back(points[order[near + i * (points.size() - near) / rest]]);
  }
  return kept;
}

surrogate::GaussianProcess FitProcess(const std::vector<ModelPoint>& points,
                                      const surrogate::GaussianProcessOptions& options) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), points.front().point.size());
  Eigen::VectorXd values(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const ModelPoint& point = points[static_cast<std::size_t>(i)];
    rows.row(i) = point.point.transpose();
    values(i) = point.quantity;
  }
  return surrogate::GaussianProcess::Fit({.points = rows, .values = values}, options);
}

}  // namespace

Eigen::MatrixXd EvenSample(int num_points, Eigen::Index num_parameters) {
  const optimizer::Points sample =
      optimizer::Sobol(num_points, static_cast<int>(num_parameters), 1);
  Eigen::MatrixXd rows(num_points, num_parameters);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = sample[static_cast<std::size_t>(i)].transpose();
  }
  return rows;
}

ObjectiveModel ObjectiveModel::Fit(std::span<const ModelPoint> points, const Eigen::VectorXd& best,
                                   const Criterion& info, double reference) {
  const auto fitted = FitProcess(Capped(points, best, kMaxFitted), {});
  if (points.size() <= kMaxFitted) return {fitted, info, reference};
  surrogate::GaussianProcessOptions frozen;
  frozen.frozen = fitted.state();
  return {FitProcess(Capped(points, best, kMaxPoints), frozen), info, reference};
}

std::vector<ObjectivePrediction> ObjectiveModel::Predict(const Eigen::MatrixXd& points) const {
  const surrogate::Predictions all = process_.PredictAll(points);
  std::vector<ObjectivePrediction> made(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    ObjectivePrediction& p = made[static_cast<std::size_t>(i)];
    p.quantity = info_.is_distance
                     ? all.mean(i)
                     : std::max(0.0, all.mean(i));  // a sum of differences is never less
    p.sd = std::sqrt(std::max(0.0, all.variance(i)));
    // Not clamped: where many points fall below 0, the least of them is still one.
    p.objective = info_.Value(all.mean(i), reference_);
    const double least = info_.Value(p.quantity - base::kNormal90 * p.sd, reference_);
    const double most = info_.Value(p.quantity + base::kNormal90 * p.sd, reference_);
    const bool spans_reference =
        info_.is_distance && std::abs(p.quantity - reference_) < base::kNormal90 * p.sd;
    p.low = spans_reference ? 0 : std::max(0.0, std::min(least, most));
    p.high = std::max(least, most);
  }
  return made;
}

Eigen::VectorXd ObjectiveModel::Minimiser(const Eigen::VectorXd& start,
                                          const Feasible& feasible) const {
  const auto less = [](const ObjectivePrediction& a, const ObjectivePrediction& b) {
    return a.objective < b.objective;
  };
  Eigen::MatrixXd candidates = EvenSample(2048, start.size());
  candidates.row(0) = start.transpose();
  Eigen::VectorXd best = start;
  base::Random random(1, base::Stream("minimiser of a compared objective"));
  for (double reach = 0.1; reach > 1e-3; reach *= 0.7) {
    auto predicted = Predict(candidates);
    for (Eigen::Index i = 0; feasible && i < candidates.rows(); ++i) {
      if (feasible(candidates.row(i).transpose())) continue;
      predicted[static_cast<std::size_t>(i)].objective = std::numeric_limits<double>::infinity();
    }
    const auto least = std::min_element(predicted.begin(), predicted.end(), less);
    best = candidates.row(least - predicted.begin()).transpose();
    candidates.resize(96, start.size());  // the best so far, and points around it, closer each time
    for (Eigen::Index i = 0; i < candidates.rows(); ++i) {
      for (Eigen::Index k = 0; k < candidates.cols(); ++k) {
        const double step = i == 0 ? 0 : reach * random.Normal();
        candidates(i, k) = std::clamp(best(k) + step, 0.0, 1.0);
      }
    }
  }
  return best;
}

double ObjectiveModel::noise_sd() const { return std::sqrt(process_.noise_variance()); }

}  // namespace talus::analysis
