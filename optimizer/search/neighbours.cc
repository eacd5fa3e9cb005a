#include "optimizer/search/neighbours.h"

#include <algorithm>

#include "optimizer/space/domain.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {

double Neighbours::DistanceOf(int rank) const {
  return distances[std::min(distances.size() - 1, static_cast<std::size_t>(rank))];
}

Neighbours NeighboursOfBest(const History& history, int count) {
  Neighbours result;
  history.values.minCoeff(&result.best);
  result.middle = history.points.row(result.best);
  const Eigen::VectorXd distances =
      (history.points.rowwise() - result.middle.transpose()).rowwise().norm();
  for (Eigen::Index i = 0; i < history.values.size(); ++i) {
    if (!surrogate::SamePoint(history.points.row(i), result.middle)) result.others.push_back(i);
  }
  std::stable_sort(result.others.begin(), result.others.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return distances[a] < distances[b]; });
  if (static_cast<int>(result.others.size()) > count) {
    result.others.resize(static_cast<std::size_t>(count));
  }
  for (const Eigen::Index i : result.others) result.distances.push_back(distances[i]);
  return result;
}

}  // namespace talus::optimizer
