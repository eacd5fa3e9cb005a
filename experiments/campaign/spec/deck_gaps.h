// Whether another engine's deck tells the experiments of a campaign apart: it simulates what its
// placeholders tell it, and what they do not tell is the same for all.
#pragma once

#include "base/problems.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {

// An experiment which differs from a former one in what no template takes would be that one
// simulated again. Nothing where the engine is ours.
void CheckDeckTellsApart(const CampaignSpec& spec, base::Problems& problems);

}  // namespace talus::campaign
