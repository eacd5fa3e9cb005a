// The order of values.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <vector>

namespace talus::optimizer {

// Their rows from the least value to the largest, none of them NaN; of equal ones the earlier
// first.
inline std::vector<Eigen::Index> Ascending(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  return order;
}

}  // namespace talus::optimizer
