// Text tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace talus::analysis {

using TextRow = std::vector<std::string>;

// Columns as wide as they must be; the first one to the left, the others to the right.
std::string Aligned(const std::vector<TextRow>& rows);

}  // namespace talus::analysis
