// What the answer owes to what was held fixed, for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/sensitivity/sensitivity_table.h"

namespace talus::analysis {

// "restitution 0.6 in place of 0.9 would move rolling_friction from 0.15 to 0.11 ± 0.01, beyond
// half of its stated range: measure it", for each move that exceeds one.
std::vector<std::string> SensitivityAlarms(const SensitivityTable& table);

std::string SensitivityText(const SensitivityTable& table);

// DIR/sensitivity.json.
std::filesystem::path SensitivityFile(const std::filesystem::path& campaign);
// Nothing where `talus sensitivity` has not been run. Throws ConfigError on a damaged file.
std::optional<SensitivityTable> LoadSensitivity(const std::filesystem::path& campaign);
void WriteSensitivity(const SensitivityTable& table, const std::filesystem::path& campaign);

}  // namespace talus::analysis
