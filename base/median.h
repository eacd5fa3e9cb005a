// The median of some values.
#pragma once

#include <algorithm>
#include <iterator>

namespace talus::base {

// `values`: a std::vector or an Eigen vector of one number at least. The upper of the two in the
// middle where their number is even.
template <class Values>
double Median(Values values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace talus::base
