// What a campaign will cost on this machine, before it is begun.
#pragma once

#include <cstdint>
#include <string>

#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::experiments {

struct CampaignEstimate {
  std::int64_t num_grains = 0;   // of a trial
  double mean_diameter = 0;      // of the scaled grains, D50 by volume [m]
  double time_step = 0;          // [s]
  double num_steps = 0;          // of a trial
  double grain_steps_per_s = 0;  // of one core, measured here
  double trial_time = 0;         // [s]
  double confirm_time = 0;       // [s], of a trial that confirms, maybe of finer grains
  int num_trials = 0;            // at most: noise, search and confirmation
  int num_workers = 0;
  double campaign_time = 0;  // [s], at most
};

// Simulates about a second of wall-clock time.
CampaignEstimate EstimateCampaign(const CampaignSpec& spec);

std::string EstimateText(const CampaignEstimate& estimate);

}  // namespace talus::experiments
