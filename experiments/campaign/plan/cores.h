// How many cores a campaign's trials take, and whether this machine has them.
#pragma once

#include <optional>
#include <string>

#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {

// MPI ranks of a trial: 1 with our own engine.
int RanksOf(const CampaignSpec& spec);

// Ranks × threads.
int CoresOfTrial(const CampaignSpec& spec);

// Trials at the same time on a machine of so many cores: as the spec says, else as many as fit.
int LocalWorkers(const CampaignSpec& spec, int num_cores);

// Trials at the same time: here as LocalWorkers, in a queue as many jobs as it may hold.
int MostAtATime(const CampaignSpec& spec, int num_cores);

// Trials that run, of so many under way: on this machine some of these wait for a core, or to be
// told.
int AtATime(const CampaignSpec& spec, int under_way);

// Cores of this machine that so many trials under way take: none where a queue runs them.
int CoresTaken(const CampaignSpec& spec, int under_way);

// In words, where trials on this machine take more cores than it has.
std::optional<std::string> CoresWarning(const CampaignSpec& spec, int num_cores);

// Cores of this machine that this process may use, >= 1.
int NumCores();

}  // namespace talus::campaign
