#include "experiments/analysis/predict/affordable.h"

#include "base/problems.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/rigs/load_case.h"

namespace talus::analysis {

using campaign::JointView;

std::vector<double> ScaleFactorsOf(const JointView& view) {
  std::vector<double> levels = view.spec.coarse_graining.Levels();
  const double target = view.spec.coarse_graining.Target();
  if (target < levels.back()) levels.push_back(target);
  return levels;
}

double CoreSecondsAt(const JointView& view, rigs::Case rig_case, double scale_factor) {
  campaign::CoreTime core_time(view.spec);
  core_time.Of(view.trials);
  rig_case.coarse_graining.scale_factor = scale_factor;
  const rigs::CaseSize size = rigs::EstimateCase(rig_case);
  const double grain_steps = size.grain_time / size.time_step;
  return grain_steps * core_time.OfOne(0, scale_factor) /
         campaign::GrainStepsOf(view.spec, 0, scale_factor);
}

bool IsPossibleAt(rigs::Case rig_case, double scale_factor) {
  rig_case.coarse_graining.scale_factor = scale_factor;
  base::Problems problems;
  rigs::ValidateCase(rig_case, problems);
  return problems.empty();
}

double AffordableScale(const JointView& view, const rigs::Case& rig_case, const RunBudget& budget) {
  const std::vector<double> levels = ScaleFactorsOf(view);
  double chosen = levels.back();
  bool found = false;
  for (const double level : levels) {
    if (!IsPossibleAt(rig_case, level)) continue;
    if (found && budget.num_runs * CoreSecondsAt(view, rig_case, level) > budget.core_time) break;
    chosen = level;
    found = true;
  }
  return chosen;
}

}  // namespace talus::analysis
