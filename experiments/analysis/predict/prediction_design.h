// DIR/predict/NAME/design.json: which sets are simulated, of what, and how often.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/prediction_plan.h"

namespace talus::analysis {

struct PredictionDesign {
  std::string test;   // the case in the middle of the ranges, without its frame; or the scene
  std::string frame;  // that the images are drawn in
  PredictedBy by = PredictedBy::kPosterior;
  int num_draws = 0;  // that were asked for
  std::int64_t last_trial = 0;
  std::vector<std::vector<double>> points{};  // unit cube
  std::vector<double> weights{};
  std::vector<PredictionStage> stages{};
  std::string source{};  // the case's file, seen from the campaign's folder

  static constexpr base::FieldKey kKeys[] = {{"last_trial", "after_trial"}};
  TALUS_FIELDS(test, frame, by, num_draws, last_trial, points, weights, stages, source);
};

}  // namespace talus::analysis
