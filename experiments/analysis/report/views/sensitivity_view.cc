#include "experiments/analysis/report/views/sensitivity_view.h"

#include <algorithm>

#include "experiments/analysis/sensitivity/sensitivity_text.h"

namespace talus::analysis {

std::optional<SensitivityView> ReadSensitivity(const Evidence& evidence) {
  if (evidence.folder.empty()) return std::nullopt;
  const std::optional<SensitivityTable> table = LoadSensitivity(evidence.folder);
  if (!table) return std::nullopt;
  // One made before a parameter was searched says nothing of it.
  const auto same = [](const SensitivityParameter& told, const ParameterInfo& parameter) {
    return told.name == parameter.range.name;
  };
  if (!std::ranges::equal(table->parameters, evidence.parameters, same)) return std::nullopt;
  return SensitivityView{.table = *table,
                         .is_outdated = HaveTrialsEndedSince(evidence, table->last_trial)};
}

}  // namespace talus::analysis
