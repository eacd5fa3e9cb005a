// A prediction that is made once more, when its campaign has gone on.
#pragma once

#include "experiments/analysis/predict/predict.h"

namespace talus::analysis {

// `options` with what an earlier call for this file had, where it has ended.
PredictOptions AsBefore(const campaign::JointView& view, PredictOptions options);

}  // namespace talus::analysis
