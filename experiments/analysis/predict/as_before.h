// A prediction that is made once more, when its campaign has gone on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/analysis/predict/predict.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/prediction_design.h"

namespace talus::analysis {

// The case's file seen from the campaign's folder: a project that is moved as a whole keeps it.
std::string SourceSeenFrom(const std::filesystem::path& campaign,
                           const std::filesystem::path& file);

// The file that a prediction made once more is of. Throws ConfigError where `folder` holds the
// prediction of a case in another file, which is still there: two cases of one file name would take
// turns in it, each with the other's trials gone.
std::string SourceToKeep(const PredictionDesign& stored, const PredictionDesign& wanted,
                         const std::filesystem::path& campaign,
                         const std::filesystem::path& folder);

// `options` with what an earlier call for this file had, where it has ended.
// With draws enough for a surrogate.
PredictOptions AsBefore(const campaign::JointView& view, PredictOptions options);

// The stages of an earlier call whose draws, where they were fewer, are now `num_draws`.
std::vector<PredictionStage> StagesAsBefore(const PredictionDesign& stored, int num_draws);

// What the prediction in a file, if there is one, says of measured values: of the same draws it
// holds still.
void KeepMeasured(const std::filesystem::path& file, Prediction& prediction);

}  // namespace talus::analysis
