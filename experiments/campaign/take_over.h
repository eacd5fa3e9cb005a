// Simulations that others have made become a campaign's own trials: those that `talus next` has
// made of a test before the test was, and those of former campaigns and designs (reuse.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/former_trials.h"
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
  const CampaignSpec& spec;    // of the campaign that has it
  int index = 0;               // its place among the campaign's
  const Reference& reference;  // what its trials are compared with
};

// Whether both search the same parameters, by name: what follows wants it.
bool SearchesTheSame(const CampaignSpec& spec, const FormerTest& test);

// Its coordinates among the searched ranges of the spec, to the last bit those it had there where
// the ranges are the same; nothing where it lies outside these ranges and constraints.
std::optional<std::vector<double>> UnitOf(const CampaignSpec& spec, const FormerTest& test,
                                          const FormerTrial& former);

// A former trial as one of the experiment, not yet numbered.
journal::TrialRecord TrialOf(const NewExperiment& experiment, const FormerTrial& former,
                             std::vector<double> unit);

// Makes the trial's folder from a former one, and adds it to `taken`. False, and nothing is left,
// where that is not complete, of another run, or cannot be read.
bool TakeOver(const CampaignFolder& folder, const NewExperiment& experiment,
              const FormerTrial& former, const journal::TrialRecord& trial,
              trials::TrialEngine& engine, TakenOver& taken);

// Puts the finished simulations of the same test into trials' folders of the campaign, which has
// `trials` already. Same test: the same case but for the image's frame. They are to be journalled
// as started; the campaign then collects them as it does what has ended without it.
TakenOver TakeOverDesigns(const CampaignFolder& folder,
                          const std::vector<journal::TrialRecord>& trials,
                          const NewExperiment& experiment, trials::TrialEngine& engine);

// "16 simulations that `talus next` had made of it are taken over"
std::string TakenOverText(const TakenOver& taken);

}  // namespace talus::campaign
