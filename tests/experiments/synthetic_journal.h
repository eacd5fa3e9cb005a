// The synthetic campaign as a folder with a journal, as `talus calibrate` would leave it.
#pragma once

#include <filesystem>

#include "experiments/analysis/compare/evidence.h"

namespace talus::experiments::test {

void WriteSyntheticJournal(const Evidence& evidence, const std::filesystem::path& folder);

}  // namespace talus::experiments::test
