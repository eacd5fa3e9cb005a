// Where a campaign stands, for people.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/campaign/plan/budget_use.h"

namespace talus::campaign {

// What a campaign has that nobody works on, though it has not ended.
inline constexpr std::string_view kEndedSilently = "ended without a word";

// Readable while it runs.
std::string StatusText(const std::filesystem::path& folder);

// What its budget was used for so far, and how long it still takes at most.
BudgetUse UseSoFar(const std::filesystem::path& folder, const CampaignSpec& spec,
                   const std::vector<journal::TrialRecord>& trials, double elapsed);

}  // namespace talus::campaign
