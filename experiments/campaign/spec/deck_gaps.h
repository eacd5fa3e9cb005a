// Whether another engine's deck tells the experiments of a campaign apart: it simulates what its
// placeholders tell it, and what they do not tell is the same for all.
#pragma once

#include <string>
#include <vector>

#include "base/problems.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {

// An experiment which differs from a former one in what no template takes would be that one
// simulated again. Nothing where the engine is ours.
void CheckDeckTellsApart(const CampaignSpec& spec, base::Problems& problems);

// "{{ rig_kind }} and {{ mass }}": in which a case, as of a process, differs from the campaign's
// first experiment and no template takes. Empty where the engine is ours.
std::string UntoldOf(const CampaignSpec& spec, const rigs::Case& rig_case);

// What is to be said of a deck that takes no seed, nor grains in place: repeated trials may be one
// run again; and of one that takes no grain size for several scale factors. None where the engine
// is ours.
std::vector<std::string> DeckWarnings(const CampaignSpec& spec);

}  // namespace talus::campaign
