#include "optimizer/acquisition/model_step.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "optimizer/acquisition/acquisition.h"
#include "optimizer/acquisition/model_search.h"

namespace talus::optimizer {
namespace {

constexpr int kNumCenters = 5;

// The evaluated points of the lowest predicted mean.
Eigen::MatrixXd Centers(const ModelView& view) {
  const Eigen::VectorXd mean = view.model.Predict(view.points).mean;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(mean.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return mean[a] < mean[b]; });
  order.resize(std::min<std::size_t>(order.size(), kNumCenters));
  return view.points(order, Eigen::all);
}

// Minus an acquisition, a function of mean and standard deviation, plus the penalty for the risk to
// fail.
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
  return {values, value_and_gradient};
}

}  // namespace

Eigen::VectorXd MostExpectedImprovement(const ModelView& view, double incumbent, double noise) {
  const auto score = [incumbent, noise](double mean, double sd) {
    return AugmentedLogExpectedImprovement(mean, sd, incumbent, noise);
  };
  return SearchCube(Negative(view, score, 1), view.domain, Centers(view), {.seed = view.seed})
      .point;
}

Eigen::VectorXd LowestMean(const ModelView& view) {
  // The mean has a unit, the logarithm of a probability has none: a failure costs as much as the
  // spread of the means seen.
  const Eigen::VectorXd seen = view.model.Predict(view.points).mean;
  const double spread = seen.maxCoeff() - seen.minCoeff();
  const auto score = [](double mean, double sd) { return NegativeLowerBound(mean, sd, 0); };
  return SearchCube(Negative(view, score, spread), view.domain, Centers(view),
                    {.num_local = 6, .seed = view.seed})
      .point;
}

double LowestBound(const ModelView& view, double num_sds) {
  const auto score = [num_sds](double mean, double sd) {
    return NegativeLowerBound(mean, sd, num_sds);
  };
  return SearchCube(Negative(view, score, 0), view.domain, Centers(view), {.seed = view.seed})
      .value;
}

}  // namespace talus::optimizer
