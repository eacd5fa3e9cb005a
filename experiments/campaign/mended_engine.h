// A wrong deck, or wrong keys of `engine`, may be mended as long as no trial has told anything with
// them: nothing that is known comes of them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// Whether it ended well and defines a number: one whose every number is undefined tells nothing.
bool HasTold(const journal::TrialRecord& trial);

// Takes the templates as they are now in place of those that the spec's hash is of. Whether they
// have changed; throws ConfigError where they are no good, or where a trial has succeeded already.
bool TakeMendedTemplates(std::span<const journal::TrialRecord> trials, CampaignSpec& spec);

// Takes what is of the engine's keys from the changes that are forbidden (ForbiddenChanges), where
// no trial has succeeded. Whether there were any.
bool AllowMendedEngine(std::span<const journal::TrialRecord> trials,
                       std::vector<base::JsonChange>& forbidden);

}  // namespace talus::campaign
