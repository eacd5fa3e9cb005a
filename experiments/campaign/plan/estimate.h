// What a campaign will cost on this machine, before it is begun.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/rigs/case/case.h"

namespace talus::campaign {

// One simulation.
struct RunEstimate {
  std::int64_t num_grains = 0;
  double mean_diameter = 0;  // of the scaled grains, D50 by volume [m]
  double time_step = 0;      // [s]
  double num_steps = 0;
  double grain_steps = 0;   // less than their product: grains come and go
  double memory = 0;        // [bytes]
  double core_seconds = 0;  // [s] of one core
};

// What a case takes by itself. Simulates for about a second of processor time.
RunEstimate EstimateRun(const rigs::Case& rig_case);

// "1013 grains of 1 mm, 2.423e+04 steps of 36.94 us, 17 MB"
std::string RunText(const RunEstimate& run);

// A trial of one experiment at one scale factor, in the middle of the ranges.
struct TrialEstimate : RunEstimate {
  int experiment = 0;
  double scale_factor = 1;
  double at_ends = 1;  // so many times as much it takes at the dearest ends of the ranges [-], >= 1

  double MostCoreSeconds() const { return at_ends * core_seconds; }
};

// A trial of each experiment at each scale factor. Simulates for about a second of processor time.
struct TrialEstimates {
  std::vector<TrialEstimate> trials;        // by experiment, then the coarsest first
  std::vector<double> grain_steps_per_s{};  // of each experiment on one core, measured here
};
TrialEstimates EstimateTrials(const CampaignSpec& spec);

struct CampaignEstimate : TrialEstimates {
  std::vector<TrialEstimate> confirming{};  // of each experiment, maybe of finer grains
  double proposal_time = 0;                 // [s] of a core, for choosing all trials
  int num_trials = 0;  // at most: noise, search and confirmation; 0: only core time ends it
  int num_workers = 0;
  double campaign_time = 0;                   // [s], at most
  double afterwards = 0;                      // [s], of what follows the answer by itself, at most
  std::optional<double> num_in_wall_clock{};  // trials of the search; none without a limit
};

// Trials of the search; 0 where no number ends it. A set that was begun gets all its replicates.
int MostSearched(const CampaignSpec& spec);

// Trials that confirm the answer, of all experiments, at most.
int MostConfirming(const CampaignSpec& spec);

// The trials, and what follows from them for the campaign.
CampaignEstimate EstimateCampaign(const CampaignSpec& spec);

// Trials that would be stopped by their time cap, a budget that ends within the first design, and
// one that buys so few trials at the smallest scale factor, or none, that the answer rests on the
// coarse ones.
std::vector<std::string> EstimateWarnings(const CampaignSpec& spec,
                                          const CampaignEstimate& estimate);

std::string EstimateText(const CampaignSpec& spec, const CampaignEstimate& estimate);

}  // namespace talus::campaign
