// The numbers that another engine's command leaves beside its spheres or image, or without any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/journal/records.h"

namespace talus::trials {

// scalars.json, {"runout_m": 0.03, …}, or scalars.csv, lines of name and value; nothing where there
// is neither. A number that is not defined is null in JSON, and empty in CSV. Throws base::Error
// with the place of what cannot be read, and where both are there.
std::vector<journal::MetricRecord> ReadScalars(const std::filesystem::path& folder);
std::vector<journal::MetricRecord> ParseJsonScalars(const std::string& text);
std::vector<journal::MetricRecord> ParseCsvScalars(const std::string& text);

// The one of the two that is read; empty where there is neither.
std::filesystem::path ScalarFile(const std::filesystem::path& folder);

// Whether a file of this name, relative to the trial's folder, would be read for the numbers.
bool IsScalarName(const std::filesystem::path& name);

// Takes away what an earlier attempt has left.
void RemoveScalars(const std::filesystem::path& folder);

}  // namespace talus::trials
