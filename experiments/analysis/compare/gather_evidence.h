// From a campaign's folder to what comparison and report work on.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

// Reads the journal, also while a process is writing it: the trials of one experiment, the first
// where none is named. Throws ConfigError when there is no such campaign or experiment.
Evidence GatherEvidence(const std::filesystem::path& campaign, const std::string& experiment = {});

// From the text of result.json.
Conclusion ConclusionOf(const std::string& result_json);

}  // namespace talus::analysis
