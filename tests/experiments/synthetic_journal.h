// The synthetic campaign as a folder with a journal, as `talus calibrate` would leave it.
#pragma once

#include <filesystem>

#include "experiments/analysis/compare/evidence.h"

namespace talus::test {

void WriteSyntheticJournal(const analysis::Evidence& evidence, const std::filesystem::path& folder);

}  // namespace talus::test
