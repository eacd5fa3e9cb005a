#include "experiments/analysis/predict/prediction_plan.h"

#include <algorithm>

#include "base/text/duration_text.h"
#include "experiments/analysis/predict/affordable.h"
#include "experiments/analysis/predict/number_surrogate.h"
#include "experiments/trials/simulate/work_text.h"

namespace talus::analysis {
namespace {

constexpr double kLongRound = 20;  // [core s] of one run of each draw: coarser ones come first

int RunsIn(const PredictionStage& stage) { return stage.num_draws * stage.num_seeds; }

double CoreTimeOf(const campaign::JointView& view, const rigs::Case& rig_case,
                  const std::vector<PredictionStage>& stages) {
  double seconds = 0;
  for (const PredictionStage& stage : stages) {
    seconds += RunsIn(stage) * CoreSecondsAt(view, rig_case, stage.scale_factor);
  }
  return seconds;
}

// The coarsest of the campaign's scale factors that the case has room for, once for each draw,
// where the first range would be long in coming.
void AddFirstLook(const campaign::JointView& view, const rigs::Case& rig_case, int num_draws,
                  std::vector<PredictionStage>& stages) {
  const double base = rig_case.coarse_graining.scale_factor;
  if (num_draws * CoreSecondsAt(view, rig_case, base) < kLongRound) return;
  for (const double level : ScaleFactorsOf(view)) {
    if (level <= base) return;
    if (!IsPossibleAt(rig_case, level)) continue;
    stages.push_back({.scale_factor = level, .num_draws = num_draws});
    return;
  }
}

// The finest scale factor of which the core time that is left holds a few runs.
void AddFiner(const campaign::JointView& view, const rigs::Case& rig_case,
              const StagesWanted& wanted, std::vector<PredictionStage>& stages) {
  const double left = wanted.core_time - CoreTimeOf(view, rig_case, stages);
  std::vector<double> finest_first = ScaleFactorsOf(view);
  std::ranges::reverse(finest_first);
  for (const double level : finest_first) {
    if (level >= rig_case.coarse_graining.scale_factor) return;
    if (!IsPossibleAt(rig_case, level)) continue;
    const double affordable = left / CoreSecondsAt(view, rig_case, level);
    if (affordable < NumberSurrogate::kFewestRuns) continue;
    const int count = static_cast<int>(std::min<double>(affordable, wanted.num_draws));
    stages.push_back({.scale_factor = level, .num_draws = count});
    return;
  }
}

}  // namespace

std::vector<PredictionStage> PlanStages(const campaign::JointView& view,
                                        const PredictedCase& predicted,
                                        const StagesWanted& wanted) {
  const rigs::Case& rig_case = predicted.rig_case;
  const bool is_free =
      !predicted.states_scale_factor && wanted.num_draws >= NumberSurrogate::kFewest;
  std::vector<PredictionStage> stages;
  for (const double coarser : wanted.coarser) {
    stages.push_back({.scale_factor = coarser, .num_draws = wanted.num_draws});
  }
  if (is_free) AddFirstLook(view, rig_case, wanted.num_draws, stages);
  stages.push_back({.scale_factor = rig_case.coarse_graining.scale_factor,
                    .num_draws = wanted.num_draws,
                    .num_seeds = wanted.num_seeds});
  if (is_free) AddFiner(view, rig_case, wanted, stages);
  return stages;
}

std::string PlanText(const campaign::JointView& view, const PredictedCase& predicted,
                     const std::vector<PredictionStage>& stages, double core_time) {
  int count = 0;
  for (const PredictionStage& stage : stages) count += RunsIn(stage);
  const double takes = CoreTimeOf(view, predicted.rig_case, stages);
  return trials::WorkText(count, "run", takes) +
         (takes > core_time ? ", more than the " + base::DurationText(core_time) +
                                  " of --budget; fewer --draws or --seeds take less"
                            : "");
}

std::vector<PlannedRun> RunsOf(const std::vector<PredictionStage>& stages, std::size_t num_draws) {
  std::vector<PlannedRun> runs;
  for (const PredictionStage& stage : stages) {
    for (int seed = 0; seed < stage.num_seeds; ++seed) {
      const std::size_t draws = std::min(num_draws, static_cast<std::size_t>(stage.num_draws));
      for (std::size_t draw = 0; draw < draws; ++draw) {
        runs.push_back({.draw = draw,
                        .seed = static_cast<std::size_t>(seed),
                        .scale_factor = stage.scale_factor});
      }
    }
  }
  return runs;
}

}  // namespace talus::analysis
