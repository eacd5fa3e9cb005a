#include "experiments/analysis/report/views/sensitivity_view.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "experiments/journal/record_json.h"

namespace talus::analysis {

std::optional<SensitivityView> ReadSensitivity(const Evidence& evidence) {
  const std::filesystem::path path = SensitivityFile(evidence.folder);
  if (evidence.folder.empty() || !std::filesystem::exists(path)) return std::nullopt;
  SensitivityView view;
  try {
    view.table = journal::ParseRecord<SensitivityTable>(base::ReadFile(path), path.string());
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(std::string(error.what()) +
                            "\nrun `talus sensitivity` again, or remove the file");
  }
  view.is_outdated = std::ranges::any_of(evidence.trials, [&](const TrialEvidence& trial) {
    return trial.id > view.table.last_trial && trial.state != journal::TrialStatus::kRunning;
  });
  return view;
}

}  // namespace talus::analysis
