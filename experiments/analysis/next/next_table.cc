#include "experiments/analysis/next/next_table.h"

#include <algorithm>
#include <tuple>

namespace talus::analysis {

double RemainingOf(const NextTable& table, const optimizer::ExpectedLearning& learning) {
  if (table.goal) return std::min(1.0, learning.goal_half_width / table.goal->half_width);
  return learning.volume;
}

void SetRemaining(NextTable& table) {
  for (NextCandidate& candidate : table.candidates) {
    if (candidate.learning) candidate.remaining = RemainingOf(table, *candidate.learning);
  }
}

void Rank(NextTable& table) {
  SetRemaining(table);
  const auto key = [](const NextCandidate& c) {
    return c.learning ? std::tuple(0, c.remaining, -c.learning->bits) : std::tuple(1, 1.0, 0.0);
  };
  std::ranges::stable_sort(table.candidates, {}, key);
}

}  // namespace talus::analysis
