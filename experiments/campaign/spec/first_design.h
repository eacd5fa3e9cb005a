// What a search simulates before it chooses trials by what the others have told.
#pragma once

#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {

// Sets of the first design, which every experiment simulates at the largest scale factor; 0 where
// the spec's own strategy has none.
int DesignSets(const CampaignSpec& spec);

// Simulations of that design and of the few sets that follow at each smaller scale factor, by every
// experiment, with those of the noise: the least that a budget needs.
int FirstSimulations(const CampaignSpec& spec);

}  // namespace talus::campaign
