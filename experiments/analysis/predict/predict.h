// `talus predict`: what draws of a campaign's posterior give in another test or process.
//
// Everything is kept in DIR/predict/NAME: draws.csv, trials/, prediction.json, pictures. What of it
// is there is not simulated again.
#pragma once

#include <filesystem>

#include "experiments/analysis/predict/predict_options.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

// Throws ConfigError where Predict would before its first run.
void CheckPrediction(const campaign::JointView& view, const PredictOptions& options);

// Throws base::Interrupted when the user ends it, with what there is written.
Prediction Predict(const campaign::JointView& view, const PredictOptions& options,
                   campaign::CampaignParts parts);

// DIR/predict, absolute, and in it that of one prediction, NAME.
std::filesystem::path PredictFolder(const std::filesystem::path& campaign);
std::filesystem::path PredictionFolder(const std::filesystem::path& campaign,
                                       const PredictOptions& options);

}  // namespace talus::analysis
