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

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("test", self.test);
    visit("frame", self.frame);
    visit("by", self.by);
    visit("num_draws", self.num_draws);
    visit("after_trial", self.last_trial);
    visit("points", self.points);
    visit("weights", self.weights);
    visit("stages", self.stages);
  }
};

}  // namespace talus::analysis
