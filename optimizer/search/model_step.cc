#include "optimizer/search/model_step.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimizer/search/acquisition.h"
#include "optimizer/space/ascending.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

constexpr int kNumCenters = 5;

// A function of one point that is computed for many at once, without gradient.
CheapFunction WithoutGradient(
    const ModelView& view, const std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>& values) {
  return {values,
          [values](const Eigen::VectorXd& x, Eigen::VectorXd*) { return values(x.transpose())[0]; },
          view.model.PredictionWork()};
}

// Minus an acquisition, a function of mean and standard deviation, plus the penalty for the risk to
// fail. With gradient.
template <class Score>
CheapFunction Negative(const ModelView& view, const Score& score, double feasibility_weight) {
  const auto values = [&view, score, feasibility_weight](const Eigen::MatrixXd& points) {
    const Moments moments = view.model.Predict(points);
    Eigen::VectorXd result = -feasibility_weight * view.feasibility.Penalty(points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      result[i] -= score(moments.mean[i], moments.sd[i]).value;
    }
    return result;
  };
  const auto value_and_gradient = [&view, score, feasibility_weight](const Eigen::VectorXd& x,
                                                                     Eigen::VectorXd* gradient) {
    const MomentsGradient at = view.model.PredictWithGradient(x);
    const Acquisition acquisition = score(at.mean, at.sd);
    Eigen::VectorXd slope;
    const double penalty = view.feasibility.Penalty(x, &slope);
    if (gradient != nullptr) {
      *gradient = -acquisition.mean_slope * at.mean_slope - acquisition.sd_slope * at.sd_slope -
                  feasibility_weight * slope;
    }
    return -acquisition.value - feasibility_weight * penalty;
  };
  return {values, value_and_gradient, view.model.PredictionWork()};
}

// The improvement that one evaluation of each point gives, chance included.
CheapFunction NegativeOwnImprovement(const ModelView& view, const Incumbent& incumbent) {
  return WithoutGradient(view, [&view, incumbent](const Eigen::MatrixXd& points) {
    const Moments moments = view.model.Predict(points);
    Eigen::VectorXd result = -view.feasibility.Penalty(points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double sd = std::hypot(moments.sd[i], incumbent.noise);
      result[i] -= LogExpectedImprovement(moments.mean[i], sd, incumbent.value).value;
    }
    return result;
  });
}

Eigen::VectorXd Search(const ModelView& view, const CheapFunction& function,
                       const Eigen::MatrixXd& centers, SearchOptions options) {
  options.seed = view.seed;
  return SearchCube(function, view.domain, centers, options).point;
}

// Where evaluations fail, the model of successes is less sure of their surroundings than one that
// has worked: the lowest such is taken in place of a point that is higher and only thought to be
// safer.
Eigen::VectorXd OrEvaluated(const ModelView& view, Eigen::VectorXd lowest) {
  const Domain likely = view.feasibility.LikelyToWork(view.domain);
  const Eigen::MatrixXd worked = Inside(likely, view.points);
  if (view.feasibility.always() || view.domain.IsList() || worked.rows() == 0) return lowest;
  Eigen::Index best = 0;
  const double value = view.model.Means(worked).minCoeff(&best);
  if (value >= view.model.Means(lowest.transpose())[0]) return lowest;
  return worked.row(best);
}

}  // namespace

Eigen::MatrixXd BestEvaluated(const ModelView& view) {
  std::vector<Eigen::Index> order = Ascending(view.model.Means(view.points));
  order.resize(std::min<std::size_t>(order.size(), kNumCenters));
  return view.points(order, Eigen::all);
}

Eigen::VectorXd MostExpectedImprovement(const ModelView& view, const Incumbent& incumbent,
                                        const Eigen::MatrixXd& centers) {
  if (incumbent.is_own_value) {
    return Search(view, NegativeOwnImprovement(view, incumbent), centers,
                  view.searches.improvement);
  }
  if (view.searches.improvement.kinked) {
    const auto values = [&](const Eigen::MatrixXd& points) -> Eigen::VectorXd {
      return -view.model.LogImprovement(points, incumbent.value, incumbent.noise) -
             view.feasibility.Penalty(points);
    };
    return Search(view, WithoutGradient(view, values), centers, view.searches.improvement);
  }
  const auto score = [&](double mean, double sd) {
    return AugmentedLogExpectedImprovement(mean, sd, incumbent.value, incumbent.noise);
  };
  return Search(view, Negative(view, score, 1), centers, view.searches.improvement);
}

Eigen::VectorXd LowestMean(const ModelView& view) { return LowestMean(view, BestEvaluated(view)); }

// The mean has a unit, the logarithm of a probability has none: a failure costs `failure_cost`.
Eigen::VectorXd LowestMean(const ModelView& view, const Eigen::MatrixXd& centers) {
  if (view.searches.mean.kinked) {
    const auto values = [&](const Eigen::MatrixXd& points) -> Eigen::VectorXd {
      return view.model.Means(points) - view.failure_cost * view.feasibility.Penalty(points);
    };
    return OrEvaluated(view,
                       Search(view, WithoutGradient(view, values), centers, view.searches.mean));
  }
  const auto score = [](double mean, double sd) { return NegativeLowerBound(mean, sd, 0); };
  return OrEvaluated(
      view, Search(view, Negative(view, score, view.failure_cost), centers, view.searches.mean));
}

double LowestBound(const ModelView& view, const Eigen::MatrixXd& centers) {
  SearchOptions options = view.searches.bound;
  options.seed = view.seed;
  const auto score = [](double mean, double sd) { return NegativeLowerBound(mean, sd, kBoundSds); };
  CheapFunction function = Negative(view, score, 0);
  if (options.kinked) function = WithoutGradient(view, function.values);
  const Found found =
      SearchCube(function, view.feasibility.LikelyToWork(view.domain), centers, options);
  return std::min(found.value, function.values(centers).minCoeff());
}

}  // namespace talus::optimizer
