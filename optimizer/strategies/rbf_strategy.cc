#include "optimizer/strategies/rbf_strategy.h"

#include <algorithm>
#include <array>

#include "optimizer/acquisition/model_search.h"
#include "optimizer/answer/answer.h"
#include "optimizer/strategies/best_observed.h"

namespace talus::optimizer {
namespace {

// Weight of the promise, the rest of the distance: from exploring to polishing.
constexpr std::array kPromise{0.3, 0.5, 0.8, 0.95, 1.0};

double NearestDistance(const Eigen::VectorXd& x, const Eigen::MatrixXd& points,
                       const std::vector<Eigen::VectorXd>& asked) {
  double nearest = (points.rowwise() - x.transpose()).rowwise().norm().minCoeff();
  for (const Eigen::VectorXd& point : asked) nearest = std::min(nearest, (point - x).norm());
  return nearest;
}

}  // namespace

RbfStrategy::RbfStrategy(const Domain& domain, const ScalarOptions& options)
    : domain_(domain), options_(options), scalar_(domain, options) {}

void RbfStrategy::Tell(const Observation& observation) {
  scalar_.Tell(observation);
  told_.push_back(observation);
  told_.back().field.clear();
}

std::vector<Proposal> RbfStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    const auto first = scalar_.BeforeModel(asked);
    if (first) {
      proposals.push_back(*first);
    } else if (scalar_.history().size() < 2) {
      proposals.push_back(scalar_.Ask(1, asked).front());
    } else {
      proposals.push_back(scalar_.NotByAccident(ByModel(asked), asked));
    }
    asked.push_back(proposals.back().point);
  }
  return proposals;
}

surrogate::RadialBasis RbfStrategy::Fit() const {
  using surrogate::RadialBasis;
  using surrogate::RadialFunction;
  const History& history = scalar_.history();
  RadialBasis cubic = RadialBasis::Fit(history.points, history.values, RadialFunction::kCubic);
  RadialBasis plate = RadialBasis::Fit(history.points, history.values, RadialFunction::kThinPlate);
  const double of_cubic = (cubic.LeaveOneOut() - history.values).squaredNorm();
  const double of_plate = (plate.LeaveOneOut() - history.values).squaredNorm();
  return of_plate < of_cubic ? plate : cubic;
}

Eigen::VectorXd RbfStrategy::Lowest(const surrogate::RadialBasis& basis) const {
  const auto values = [&](const Eigen::MatrixXd& points) {
    Eigen::VectorXd result(points.rows());
    for (Eigen::Index i = 0; i < points.rows(); ++i) result[i] = basis.Predict(points.row(i));
    return result;
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
    if (gradient != nullptr) *gradient = basis.Gradient(x);
    return basis.Predict(x);
  };
  const History& history = scalar_.history();
  Eigen::Index best = 0;
  history.values.minCoeff(&best);
  return SearchCube({values, value}, domain_, history.points.row(best), {.seed = options_.seed})
      .point;
}

Eigen::VectorXd RbfStrategy::ByModel(const Points& asked) const {
  const surrogate::RadialBasis basis = Fit();
  const History& history = scalar_.history();
  const std::size_t index = told_.size() + asked.size();
  const double promise = kPromise[index % kPromise.size()];
  const Eigen::VectorXd lowest = Lowest(basis);
  const double least = basis.Predict(lowest);
  const double spread = std::max(history.values.maxCoeff() - least, 1e-300);
  const auto values = [&](const Eigen::MatrixXd& points) {
    Eigen::VectorXd result = -scalar_.feasibility().Penalty(points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::VectorXd x = points.row(i);
      result[i] += promise * (basis.Predict(x) - least) / spread -
                   (1 - promise) * NearestDistance(x, history.points, asked);
    }
    return result;
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return values(x.transpose())[0];
  };
  return SearchCube({values, value}, domain_, lowest.transpose(),
                    {.num_local = 2, .kinked = true, .seed = options_.seed + 7919 * index})
      .point;
}

Answer RbfStrategy::Recommend() {
  Answer answer = BestObserved(told_, domain_, "radial basis functions");
  if (scalar_.history().size() < 2) return answer;
  const surrogate::RadialBasis basis = Fit();
  answer.model = "radial basis functions of " + std::to_string(scalar_.history().size()) +
                 " evaluations" + (basis.smoothing() > 0 ? ", smoothed" : "") +
                 "; they say nothing of their own uncertainty";
  // An interpolant is right at the evaluations and only there; a smooth one sees through luck.
  if (scalar_.deterministic()) return answer;
  answer.point = Lowest(basis);
  answer.predicted_value = basis.Predict(answer.point);
  answer.warnings = BoundWarnings(answer.point);
  return answer;
}

}  // namespace talus::optimizer
