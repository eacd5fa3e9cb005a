// The median of some values.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace talus::optimizer {

// One value at least; the upper of the two in the middle where their number is even.
inline double Median(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace talus::optimizer
