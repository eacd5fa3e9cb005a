// What `talus sensitivity` has found for a campaign, read from the file that it leaves there.
#pragma once

#include <optional>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/sensitivity/sensitivity_table.h"

namespace talus::analysis {

struct SensitivityView {
  SensitivityTable table;
  bool is_outdated = false;  // trials have ended since
};

// Nothing where `talus sensitivity` has not been run. Throws ConfigError on a damaged file.
std::optional<SensitivityView> ReadSensitivity(const Evidence& evidence);

}  // namespace talus::analysis
