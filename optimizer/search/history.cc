#include "optimizer/search/history.h"

#include <algorithm>

namespace talus::optimizer {
namespace {

Eigen::VectorXd Somewhere(const Domain& domain) {
  if (!domain.guesses.empty()) return domain.guesses.front();
  return Eigen::VectorXd::Constant(domain.num_parameters, 0.5);
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

Repeats FindRepeats(const History& history) {
  Repeats repeats;
  bool differs = false;
  for (Eigen::Index i = 1; i < history.values.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (!SamePoint(history.points.row(i), history.points.row(j))) continue;
      ++repeats.num_repeats;
      differs = differs || history.values[i] != history.values[j];
      break;
    }
  }
  repeats.deterministic = repeats.num_repeats > 0 && !differs;
  return repeats;
}

Answer BestObserved(std::span<const Observation> told, const Domain& domain,
                    const std::string& how) {
  Answer answer;
  answer.correlation = Eigen::MatrixXd::Identity(domain.num_parameters, domain.num_parameters);
  answer.model = "no model: the best observation of " + how;
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
    if (answer.point[i] > kSamePoint && answer.point[i] < 1 - kSamePoint) continue;
    answer.warnings.push_back(
        {.parameter = static_cast<int>(i), .is_upper = answer.point[i] > 0.5});
  }
  return answer;
}

}  // namespace talus::optimizer
