// An experiment that the answer is made without, as the answer predicts it and as it was measured.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/field.h"

namespace talus::campaign {

// A number that was measured beside what the other experiments predict of it.
struct PredictedNumber {
  std::string name;  // of the metric: "mass_fallen_kg"
  double mean = 0;   // predicted, over the others' posterior
  double sd = 0;     // … of that and of the surrogate: without the measurement's error
  double low = 0;    // 5 % and 95 % of what is predicted to be measured
  double high = 0;
  double measured = 0;
  double measured_sd = 0;

  bool IsInside() const { return measured >= low && measured <= high; }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("predicted", self.mean);
    visit("predicted_sd", self.sd);
    visit("predicted_low", self.low);
    visit("predicted_high", self.high);
    visit("measured", self.measured);
    visit("measured_sd", self.measured_sd);
  }
};

struct ResultHeldOut {
  std::string name;
  // Objective of the predicted mean image at the answer; NaN without images.
  double predicted = std::numeric_limits<double>::quiet_NaN();
  double predicted_sd = std::numeric_limits<double>::quiet_NaN();
  double implausibility = 0;        // at the answer [standard deviations]
  double least_implausibility = 0;  // over the others' joint 90 % region
  std::vector<PredictedNumber> numbers{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("predicted_objective", self.predicted);
    visit("predicted_objective_sd", self.predicted_sd);
    visit("implausibility", self.implausibility);
    visit("least_implausibility", self.least_implausibility);
    visit("numbers", self.numbers);
  }
};

}  // namespace talus::campaign
