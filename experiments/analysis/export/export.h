// A campaign's trials as tables for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/journal/records.h"

namespace talus::analysis {

// One line a trial; the head names each column with its unit. What is not defined is empty.
std::string TrialsCsv(const journal::CampaignRecord& campaign,
                      const std::vector<journal::TrialRecord>& trials);

// The same with the campaign, its reference metrics and the reasons where a metric is undefined.
std::string TrialsJson(const journal::CampaignRecord& campaign,
                       const std::vector<journal::TrialRecord>& trials);

// trials.csv and trials.json into `out`; readable while the campaign runs.
void ExportCampaign(const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace talus::analysis
