#include "optimizer/search/history.h"

#include <algorithm>
#include <cmath>

#include "optimizer/designs/points_within.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

Eigen::VectorXd Somewhere(const Domain& domain) {
  if (!domain.guesses.empty()) return domain.guesses.front();
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(domain.num_parameters, 0.5);
  return domain.Snap(domain.Contains(middle) ? middle : SobolPoint(domain, 0, 0));
}

}  // namespace

History MakeHistory(std::span<const Observation> told, int num_parameters) {
  const auto num_failed =
      std::count_if(told.begin(), told.end(), [](const Observation& seen) { return seen.failed; });
  const auto num_good = static_cast<Eigen::Index>(told.size()) - num_failed;
  History history{.points = Eigen::MatrixXd(num_good, num_parameters),
                  .values = Eigen::VectorXd(num_good),
                  .failed = Eigen::MatrixXd(num_failed, num_parameters)};
  Eigen::Index good = 0;
  Eigen::Index bad = 0;
  for (const Observation& seen : told) {
    if (seen.failed) {
      history.failed.row(bad++) = seen.point;
    } else {
      history.points.row(good) = seen.point;
      history.values[good++] = seen.value;
    }
  }
  return history;
}

void Repeats::CountLast(const History& history) {
  const Eigen::Index last = history.values.size() - 1;
  const Eigen::VectorXd point = history.points.row(last);
  for (Eigen::Index j = 0; j < last; ++j) {
    if (!surrogate::SamePoint(point, history.points.row(j))) continue;
    ++num_repeats;
    differs = differs || history.values[last] != history.values[j];
    return;
  }
}

Answer BestObserved(std::span<const Observation> told, const Domain& domain,
                    const std::string& seen) {
  Answer answer;
  answer.model = "no model: the best observation of " + seen;
  const Observation* best = nullptr;
  for (const Observation& observation : told) {
    if (!observation.failed && (best == nullptr || observation.value < best->value)) {
      best = &observation;
    }
  }
  if (best == nullptr) {
    answer.point = Somewhere(domain);
    answer.is_guess = true;
    return answer;
  }
  answer.point = best->point;
  answer.predicted_value = best->value;
  for (Eigen::Index i = 0; i < answer.point.size(); ++i) {
    const double at = answer.point[i];
    const bool is_between = at > surrogate::kSamePoint && at < 1 - surrogate::kSamePoint;
    // One that has had a single value so far says nothing of its bounds.
    const bool varied = std::ranges::any_of(told, [&](const Observation& other) {
      return std::abs(other.point[i] - at) > surrogate::kSamePoint;
    });
    if (is_between || !varied) continue;
    answer.warnings.push_back({.parameter = static_cast<int>(i), .is_upper = at > 0.5});
  }
  return answer;
}

}  // namespace talus::optimizer
