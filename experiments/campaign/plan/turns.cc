#include "experiments/campaign/plan/turns.h"

namespace talus::campaign {

std::optional<std::int64_t> NextInTurn(std::span<const journal::TrialRecord> trials) {
  const journal::TrialRecord* next = nullptr;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.status != journal::TrialStatus::kRunning) continue;
    if (next == nullptr || trial.due < next->due) next = &trial;  // by id where both are due
  }
  return next == nullptr ? std::nullopt : std::optional(next->id);
}

}  // namespace talus::campaign
