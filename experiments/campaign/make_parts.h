// The runner and the engine that a spec names.
#pragma once

#include <filesystem>
#include <memory>

#include "experiments/campaign/campaign.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/runners/runner.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

// `folder` is the campaign's, absolute.
std::unique_ptr<runners::Runner> MakeRunner(const CampaignSpec& spec,
                                            const std::filesystem::path& folder);
std::unique_ptr<trials::TrialEngine> MakeEngine(const CampaignSpec& spec);

// Both. A queue's own files stand in `folder`.
CampaignParts MakeParts(const CampaignSpec& spec, const std::filesystem::path& folder);

}  // namespace talus::campaign
