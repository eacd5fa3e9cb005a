// From a campaign's folder to what comparison and report work on.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/analysis/compare/evidence.h"

namespace talus::experiments {

// Reads the journal, also while a process is writing it. Throws ConfigError when there is none.
Evidence GatherEvidence(const std::filesystem::path& campaign);

// From the text of result.json.
Conclusion ConclusionOf(const std::string& result_json);

}  // namespace talus::experiments
