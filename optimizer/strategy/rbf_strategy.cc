#include "optimizer/strategy/rbf_strategy.h"

#include <algorithm>
#include <array>
#include <utility>

#include "optimizer/search/describe_minimum.h"
#include "optimizer/search/history.h"
#include "optimizer/search/model_search.h"

namespace talus::optimizer {
namespace {

// Weight of the predicted value, in turn; the rest is that of the distance: from exploring to
// polishing.
constexpr std::array kValueWeight{0.3, 0.5, 0.8, 0.95, 1.0};

double NearestDistance(const Eigen::VectorXd& x, const Eigen::MatrixXd& points,
                       const std::vector<Eigen::VectorXd>& asked) {
  double nearest = (points.rowwise() - x.transpose()).rowwise().norm().minCoeff();
  for (const Eigen::VectorXd& point : asked) nearest = std::min(nearest, (point - x).norm());
  return nearest;
}

}  // namespace

const surrogate::RadialBasis& RbfStrategy::Fit() {
  if (fit_) return *fit_;
  using surrogate::RadialBasis;
  using surrogate::RadialFunction;
  const History& history = record().history();
  RadialBasis cubic = RadialBasis::Fit(history.points, history.values, RadialFunction::kCubic);
  RadialBasis plate = RadialBasis::Fit(history.points, history.values, RadialFunction::kThinPlate);
  const double of_cubic = (cubic.LeaveOneOut() - history.values).squaredNorm();
  const double of_plate = (plate.LeaveOneOut() - history.values).squaredNorm();
  return fit_.emplace(of_plate < of_cubic ? std::move(plate) : std::move(cubic));
}

// Where evaluations are likely to fail the surrogate, which knows none there, says nothing.
Eigen::VectorXd RbfStrategy::Lowest(const surrogate::RadialBasis& basis) const {
  const History& history = record().history();
  const Feasibility& feasibility = record().feasibility();
  const double failure_cost = history.values.maxCoeff() - history.values.minCoeff();
  const auto values = [&](const Eigen::MatrixXd& points) {
    Eigen::VectorXd result = -failure_cost * feasibility.Penalty(points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) result[i] += basis.Predict(points.row(i));
    return result;
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(x.size());
    const double penalty = feasibility.Penalty(x, gradient != nullptr ? &slope : nullptr);
    if (gradient != nullptr) *gradient = basis.Gradient(x) - failure_cost * slope;
    return basis.Predict(x) - failure_cost * penalty;
  };
  Eigen::Index best = 0;
  history.values.minCoeff(&best);
  return SearchCube({values, value}, record().domain(), history.points.row(best),
                    {.seed = record().options().seed})
      .point;
}

Proposal RbfStrategy::ByModel(const Points& asked) {
  const surrogate::RadialBasis& basis = Fit();
  const History& history = record().history();
  const std::size_t index = record().told().size() + asked.size();
  const double value_weight = kValueWeight[index % kValueWeight.size()];
  const Eigen::VectorXd lowest = Lowest(basis);
  const double least = basis.Predict(lowest);
  // Values that are all the same but for rounding say nothing of where to go.
  const double range = std::max(
      {history.values.maxCoeff() - least, 1e-9 * history.values.cwiseAbs().maxCoeff(), 1e-300});
  const Feasibility& feasibility = record().feasibility();
  const auto values = [&](const Eigen::MatrixXd& points) {
    Eigen::VectorXd result = -feasibility.Penalty(points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::VectorXd x = points.row(i);
      result[i] += value_weight * (basis.Predict(x) - least) / range -
                   (1 - value_weight) * NearestDistance(x, history.points, asked);
    }
    return result;
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return values(x.transpose())[0];
  };
  const Found found =
      SearchCube({values, value}, record().OpenDomain(asked), lowest.transpose(),
                 {.num_local = 2, .kinked = true, .seed = record().StepSeed(asked)});
  return record().ReplicateOrPerturb(found.point, asked);
}

Answer RbfStrategy::Recommend() {
  Answer answer = BestObserved(record().told(), record().domain(), "those so far, too few for one");
  if (record().history().size() < 2) return answer;
  const surrogate::RadialBasis& basis = Fit();
  answer.model = "radial basis functions of " + std::to_string(record().history().size()) +
                 " evaluations" + (basis.smoothing() > 0 ? ", smoothed" : "") +
                 "; they say nothing of their own uncertainty";
  // An interpolant is right at the evaluations and only there; a smooth one averages the noise.
  if (record().deterministic()) return answer;
  answer.point = Lowest(basis);
  answer.predicted_value = basis.Predict(answer.point);
  answer.warnings = BoundWarnings(answer.point);
  return answer;
}

}  // namespace talus::optimizer
