// From a campaign's folder to what comparison and report work on.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

// Reads the journal, also while a process is writing it: the trials of one experiment, the first
// where none is named. Throws ConfigError when there is no such campaign or experiment.
Evidence GatherEvidence(const std::filesystem::path& campaign, const std::string& experiment = {});

// The same campaign with each of its further experiments shown.
std::vector<Evidence> GatherOthers(const std::filesystem::path& campaign, const Evidence& evidence);

// Adds the model that the campaign's strategy answers with, or why there is none to ask; to its
// other experiments, too.
void AddModel(const std::filesystem::path& campaign, Evidence& evidence,
              std::span<Evidence> others = {});

}  // namespace talus::analysis
