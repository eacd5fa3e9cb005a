#include "experiments/campaign/answer/verdict.h"

#include <cmath>

namespace talus::campaign {
std::optional<std::pair<std::size_t, std::size_t>> TiedPair(
    const std::vector<std::vector<double>>& correlation, double least) {
  std::optional<std::pair<std::size_t, std::size_t>> pair;
  double most = least;
  for (std::size_t i = 0; i < correlation.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(std::abs(correlation[i][j]) >= most)) continue;
      most = std::abs(correlation[i][j]);
      pair = {j, i};
    }
  }
  return pair;
}

}  // namespace talus::campaign
