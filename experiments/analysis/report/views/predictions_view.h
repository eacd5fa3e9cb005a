// What `talus predict` has found for a campaign, read from the folders that it leaves there.
#pragma once

#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/analysis/predict/prediction.h"

namespace talus::analysis {

struct PredictionView {
  Prediction prediction;
  bool is_outdated = false;  // trials have ended since
  Picture mean;              // silhouette with its outlines; without a PNG where there is none
  Picture different;
};

// By the names of their folders; those by one set alone, too. Throws ConfigError on a damaged file.
std::vector<PredictionView> ReadPredictions(const Evidence& evidence);

}  // namespace talus::analysis
