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

// In what a case, as of a process, differs from the campaign's own test of its rig, and no template
// takes.
struct DeckGap {
  std::string experiment{};  // that test, or the first where there is none of this rig
  std::string untold{};      // "{{ mass }} and {{ rig_kind }}"; empty: all is told, or our engine's
  bool is_other_rig = false;  // of which the deck is not told: it would simulate that test again
};
DeckGap DeckGapOf(const CampaignSpec& spec, const rigs::Case& rig_case);

// What is to be said of a deck that takes no seed, nor grains in place: repeated trials may be one
// run again; and of one that takes no grain size for several scale factors. None where the engine
// is ours.
std::vector<std::string> DeckWarnings(const CampaignSpec& spec);

}  // namespace talus::campaign
