#include "optimizer/search/history.h"

#include <algorithm>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

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

}  // namespace talus::optimizer
