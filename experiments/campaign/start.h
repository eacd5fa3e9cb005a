// How campaigns begin and go on: from a spec to a folder with a journal, and from such a folder to
// a campaign that runs.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.h"
#include "experiments/campaign/spec_change.h"
#include "experiments/trials/engines/trial_engine.h"
#include "imaging/photos/experiment.h"

namespace talus::campaign {

// The free parameters as the journal keeps them.
std::vector<journal::ParameterRecord> SearchedParameters(const CampaignSpec& spec);

// Measures the experiment; throws ConfigError where it cannot be used with this spec.
journal::CampaignRecord MakeRecord(const CampaignSpec& spec, const base::JsonFile& file);

// Measures one experiment, by its place; throws ConfigError where its images are no good.
journal::ExperimentRecord MakeExperimentRecord(const CampaignSpec& campaign, int experiment);

struct BeginOptions {
  std::optional<std::string> hold_out{};  // instead of the spec's
  // Former campaigns and designs, whose simulations are told first: reuse.h.
  std::vector<std::filesystem::path> reuse{};
  // Told how photographs are read and what is taken of former trials, once the folder is there.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  // The engine that the campaign simulates with; tests put another in its place.
  std::function<std::unique_ptr<trials::TrialEngine>()> engine{};
  // Throws ConfigError on what this floor cannot see, before anything is written.
  std::function<void(const CampaignSpec&)> check = [](const CampaignSpec&) {};
};

// Makes the folder and the journal of a new campaign. Nothing is written when the spec, the
// experiment's images or the folders to reuse are no good.
void BeginCampaign(const std::filesystem::path& spec_path, const std::filesystem::path& folder,
                   const BeginOptions& options = {});

struct OpenedCampaign {
  CampaignFolder folder;
  CampaignLock lock;
  journal::Journal journal;
  CampaignSpec spec;
  bool engine_is_new = false;  // mended_engine.h; CampaignParts is to be told
};

// Throws ConfigError where what is asked does not go with the spec that the campaign would go on
// by, or with its experiments.
using OpenCheck = std::function<void(const CampaignSpec&, const journal::CampaignRecord&)>;

// Opens a campaign to go on with it. Repairs a damaged journal from the trials' folders. Throws
// ConfigError that names what has changed in the spec where that is not allowed.
// `check` is called before anything of the campaign is changed.
OpenedCampaign OpenCampaign(
    const std::filesystem::path& folder, const ResumeOptions& options, Console& console,
    const OpenCheck& check = [](const CampaignSpec&, const journal::CampaignRecord&) {});

}  // namespace talus::campaign
