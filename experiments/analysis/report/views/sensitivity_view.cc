#include "experiments/analysis/report/views/sensitivity_view.h"

#include <algorithm>

#include "experiments/analysis/sensitivity/sensitivity_text.h"

namespace talus::analysis {

std::optional<SensitivityView> ReadSensitivity(const Evidence& evidence) {
  if (evidence.folder.empty()) return std::nullopt;
  const std::optional<SensitivityTable> table = LoadSensitivity(evidence.folder);
  if (!table) return std::nullopt;
  SensitivityView view{.table = *table};
  view.is_outdated = std::ranges::any_of(evidence.trials, [&](const TrialEvidence& trial) {
    return trial.id > view.table.last_trial && trial.state != journal::TrialStatus::kRunning;
  });
  return view;
}

}  // namespace talus::analysis
