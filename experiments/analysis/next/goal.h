// What `talus next --for` is asked for: a number of another test or process, as a function of the
// parameters. It comes from the runs of `talus predict`, kept in DIR/predict/NAME.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/analysis/predict/number_surrogate.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

struct GoalRequest {
  std::filesystem::path file;  // of a case or a scene
  std::string observable{};    // as specs or results name it; empty: the only one that is usual
};

struct Goal {
  std::string process;  // the file's name without its ending
  std::string number;   // "packing_fraction", "angle_deg"
  NumberSurrogate surrogate;
  double scale_factor = 1;  // that the surrogate tells it at
  int num_draws = 0;
  int num_runs = 0;
  double core_time = 0;  // of these [s]
};

// Simulates what of the runs is missing. Throws ConfigError where the file contradicts the campaign
// or does not have the number, base::Error where too few runs define it.
Goal SimulateGoal(const campaign::JointView& view, const GoalRequest& request,
                  campaign::CampaignParts parts);

}  // namespace talus::analysis
