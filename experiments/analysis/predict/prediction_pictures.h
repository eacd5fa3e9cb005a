// What a prediction looks like.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/prediction_runs.h"

namespace talus::analysis {

// The mean of images of one size, each with its weight.
imaging::GrayImage WeightedMean(std::span<const imaging::GrayImage> images,
                                const std::vector<double>& weights);

// mean_profile.png: the mean silhouette over all draws with two outlines, what 95 % of the single
// runs fill (inner) and what 5 % do (outer). most_different.png: the mean silhouettes of the two
// draws that differ most. Names both in the prediction; writes nothing where runs have no images.
void WritePictures(const PredictionRuns& runs, const std::filesystem::path& folder,
                   Prediction& prediction);

}  // namespace talus::analysis
