// A table of candidate points: a CSV file whose head names the parameters.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus::optimizer {

inline constexpr int kMaxCandidates = 10000;

// One row of native values a candidate, in the order of `names`; other columns are left alone.
// Throws base::ConfigError with file and line.
std::vector<std::vector<double>> ReadCandidateTable(const std::filesystem::path& path,
                                                    const std::vector<std::string>& names);

}  // namespace talus::optimizer
