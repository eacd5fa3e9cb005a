#include "experiments/campaign/answer/best_confirmed.h"

#include <algorithm>
#include <cmath>

namespace talus::campaign {
namespace {

// The luckiest run is no argument; a mean that is lower by twice its error is one.
std::size_t BestOf(const std::vector<ResultCandidate>& candidates) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const double error = std::hypot(candidates[i].standard_error, candidates[0].standard_error);
    if (candidates[i].mean < candidates[0].mean - 2 * error &&
        candidates[i].mean < candidates[best].mean) {
      best = i;
    }
  }
  return best;
}

}  // namespace

void TakeBestConfirmed(CampaignResult& result) {
  const std::size_t best = BestOf(result.confirmed);
  if (best == 0) return;
  const auto first = result.confirmed.begin();
  std::rotate(first, first + static_cast<long>(best), first + static_cast<long>(best) + 1);
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    result.parameters[i].value = result.confirmed[0].values[i];
  }
  result.warnings.push_back(Worded({.kind = WarningKind::kNotModelsChoice}));
}

}  // namespace talus::campaign
