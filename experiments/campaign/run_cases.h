// Simulates cases beside a campaign's own trials, by its engine and runner, each in a folder of its
// own. What is complete there is not run again, nor what has failed as it is prepared now, by a
// result that is refused or by none, unless all have: the same call goes on where another was
// ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>

#include "experiments/campaign/campaign.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

struct FolderCase {
  std::filesystem::path folder;
  rigs::Case rig_case;
};

struct CaseRuns {
  const CampaignSpec& spec;  // whose time cap and cores each has
  std::size_t count = 0;
  std::function<FolderCase(std::size_t)> at;
  // Told of each when it has ended, well or not; those that were complete count as well.
  std::function<void(std::size_t)> has_ended = [](std::size_t) {};
};

// What has become of a case.
struct CaseOutcome {
  bool has_ended = false;                       // well or not
  double core_time = 0;                         // of all attempts at it [s]
  std::optional<trials::TrialOutput> output{};  // of one that has ended well
};
CaseOutcome OutcomeOf(const FolderCase& run, trials::TrialEngine& engine);

// False when the user ended it; what has ended is kept.
bool RunCases(const CaseRuns& runs, const CampaignParts& parts);
// The same where somebody listens to the user already.
bool RunCases(const CaseRuns& runs, const CampaignParts& parts,
              const base::InterruptGuard& interrupt);

}  // namespace talus::campaign
