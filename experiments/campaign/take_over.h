// Simulations that `talus next` has made of a test before the test was: the campaign's own trials,
// once the test is one of its experiments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

struct TakenOver {
  std::vector<journal::TrialRecord> trials;  // numbered on from the campaign's, as running
  double core_time = 0;                      // that they took [s]
};

struct NewExperiment {
  const CampaignSpec& spec;    // which has it
  int index = 0;               // of it
  const Reference& reference;  // of it
};

// Puts the finished simulations of the same test into trials' folders of the campaign, which has
// `trials` already. Same test: the same case but for the image's frame. They are to be journalled
// as started; the campaign then collects them as it does what has ended without it.
TakenOver TakeOverDesigns(const CampaignFolder& folder,
                          const std::vector<journal::TrialRecord>& trials,
                          const NewExperiment& experiment, trials::TrialEngine& engine);

// "16 simulations that `talus next` had made of it are taken over"
std::string TakenOverText(const TakenOver& taken);

}  // namespace talus::campaign
