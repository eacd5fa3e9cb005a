// From a campaign's folder to what comparison and report work on.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

// Reads the journal, also while a process is writing it: the trials of one experiment, the first
// where none is named. Throws ConfigError when there is no such campaign or experiment.
Evidence GatherEvidence(const std::filesystem::path& campaign, const std::string& experiment = {});

// Adds the model that the campaign's strategy answers with, or why there is none to ask.
void AddModel(const std::filesystem::path& campaign, Evidence& evidence);

}  // namespace talus::analysis
