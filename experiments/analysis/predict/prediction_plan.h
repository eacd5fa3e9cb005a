// Which runs a prediction is made of: of how many draws, how often, at which scale factors.
//
// One stage has every draw with several seeds: it tells parameters and scatter apart. Beside it
// stand coarser runs, one a draw, that are there soon, and as many finer ones as the core time
// allows: from all of them a surrogate tells the target (number_surrogate.h).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// The first draws, each with so many seeds. Stages run in their order; in one, every draw once,
// then every draw again, so that the first few runs show the range already.
struct PredictionStage {
  double scale_factor = 1;
  int num_draws = 0;
  int num_seeds = 1;

  TALUS_FIELDS(scale_factor, num_draws, num_seeds);
};

struct PlannedRun {
  std::size_t draw = 0;
  std::size_t seed = 0;  // from 0
  double scale_factor = 1;
};

// The stage of `predicted`, and those that the core time [s] allows beside it. `coarser` are scale
// factors that the user has asked for, too; where the file or the user states one alone, nothing
// stands beside it.
struct StagesWanted {
  int num_draws = 1;
  int num_seeds = 1;
  std::vector<double> coarser{};
  double core_time = 0;
};
std::vector<PredictionStage> PlanStages(const campaign::JointView& view,
                                        const PredictedCase& predicted, const StagesWanted& wanted);

// Where there are fewer draws than the stages have, of those that there are.
std::vector<PlannedRun> RunsOf(const std::vector<PredictionStage>& stages, std::size_t num_draws);

// "36 runs, about 2 min of core time"; with what takes less where that is more than `core_time`
// [s].
std::string PlanText(const campaign::JointView& view, const PredictedCase& predicted,
                     const std::vector<PredictionStage>& stages, double core_time);

}  // namespace talus::analysis
