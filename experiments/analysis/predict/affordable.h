// What simulations of another test or process cost, and at which of a campaign's scale factors they
// can be afforded. By the speed that the campaign's trials had.
#pragma once

#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "experiments/rigs/case/case.h"

namespace talus::analysis {

// Simulations that are meant to be made, and what they may take.
struct RunBudget {
  int num_runs = 1;
  double core_time = 0;  // of all [s]
};

// Those that the campaign simulates and the one that it answers for, the coarsest first.
std::vector<double> ScaleFactorsOf(const campaign::JointView& view);

// What one simulation takes [core s].
double CoreSecondsAt(const campaign::JointView& view, rigs::Case rig_case, double scale_factor);

// Whether the vessel has room for grains so coarse.
bool IsPossibleAt(rigs::Case rig_case, double scale_factor);

// The finest that all runs can afford, else the coarsest that the case has room for.
double AffordableScale(const campaign::JointView& view, const rigs::Case& rig_case,
                       const RunBudget& budget);

}  // namespace talus::analysis
