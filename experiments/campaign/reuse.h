// `talus calibrate --reuse`: what former campaigns and designs have simulated of the same powder on
// the same devices is told to the search before anything else. The grains are drawn anew in the new
// photographs' frame; a trial keeps its seed, its scale factor and what it has cost.
//
// Same: the case of an experiment here is that of the trial but for the frame, to the last bit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/former_trials.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

// Who asks for simulations of others.
struct Reuser {
  const CampaignSpec& spec;
  const std::vector<Reference>& references;  // of its experiments
  trials::TrialEngine& engine;
};

struct ReusePlan {
  struct Trial {
    FormerTrial former;
    journal::TrialRecord record;  // here, not yet numbered
  };
  std::vector<Trial> trials{};
  // A line for people on each folder: what is taken, what is left out and why.
  std::vector<std::string> messages{};
};

// Writes nothing. A simulation that several folders hold is taken once. Throws ConfigError where a
// folder is none of a campaign or a design, and, with the reasons, where nothing there fits.
ReusePlan PlanReuse(const Reuser& reuser, const std::vector<std::filesystem::path>& folders);

// Copies them beside the trials of a campaign that is about to begin, and returns those that could
// be read, numbered from 1; a message of the plan counts the others. What another process was
// killed at is cleared first.
std::vector<journal::TrialRecord> CopyReused(const Reuser& reuser, const CampaignFolder& folder,
                                             ReusePlan& plan);
// Makes the copies the campaign's trials, in one step; nothing where there are none. To be called
// once the campaign is on the disk, by whichever process comes so far.
void AdoptCopies(const CampaignFolder& folder);

// The folder of the copies, until they are adopted.
inline constexpr const char* kCopiesFolder = "reused.part";

}  // namespace talus::campaign
