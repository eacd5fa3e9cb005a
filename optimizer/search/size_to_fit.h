// How many evaluations hyper-parameters are fitted to.
#pragma once

#include <cmath>

namespace talus::optimizer {

// The largest of `fewest`, 1.15 times as many, … that `size` reaches. It depends on nothing but
// `size`, as what a strategy proposes must not depend on when it was asked.
inline int SizeToFit(int size, int fewest) {
  constexpr double kGrowth = 1.15;  // from one fit to the next
  int fit = fewest;
  for (int next = fit; next <= size; next = static_cast<int>(std::ceil(kGrowth * next))) fit = next;
  return fit;
}

}  // namespace talus::optimizer
