// Simulates cases beside a campaign's own trials, by its engine and runner, each in a folder of its
// own. What is complete there is not run again, nor what has failed as it is prepared now: the same
// call goes on where another was ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>

#include "experiments/campaign/campaign.h"
#include "experiments/rigs/case/case.h"

namespace talus::campaign {

struct FolderCase {
  std::filesystem::path folder;
  rigs::Case rig_case;
};

struct CaseRuns {
  std::size_t count = 0;
  std::function<FolderCase(std::size_t)> at;
  double time_cap = 0;  // of each, wall-clock [s], > 0
  // Told of each when it has ended, well or not; those that were complete count as well.
  std::function<void(std::size_t)> has_ended = [](std::size_t) {};
};

// What a case took whose folder holds the mark of a failure [s]; nothing of others.
std::optional<double> TimeOfFailure(const std::filesystem::path& folder);

// False when the user ended it; what has ended is kept.
bool RunCases(const CaseRuns& runs, const CampaignParts& parts);
// The same where somebody listens to the user already.
bool RunCases(const CaseRuns& runs, const CampaignParts& parts,
              const base::InterruptGuard& interrupt);

}  // namespace talus::campaign
