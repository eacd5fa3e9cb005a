// An experiment that the answer is made without, as the answer predicts it and as it was measured.
#pragma once

#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"

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

  static constexpr base::FieldKey kKeys[] = {{"mean", "predicted"},
                                             {"sd", "predicted_sd"},
                                             {"low", "predicted_low"},
                                             {"high", "predicted_high"}};
  TALUS_FIELDS(name, mean, sd, low, high, measured, measured_sd);
};

struct ResultHeldOut {
  std::string name;
  // Objective of the predicted mean image at the answer; NaN without images.
  double predicted = base::kNotKnown;
  double predicted_sd = base::kNotKnown;
  // At the answer [standard deviations], and the least over the others' joint 90 % region; NaN
  // where there is no posterior yet to predict it by.
  double implausibility = base::kNotKnown;
  double least_implausibility = base::kNotKnown;
  std::vector<PredictedNumber> numbers{};

  static constexpr base::FieldKey kKeys[] = {{"predicted", "predicted_objective"},
                                             {"predicted_sd", "predicted_objective_sd"}};
  TALUS_FIELDS(name, predicted, predicted_sd, implausibility, least_implausibility, numbers);
};

}  // namespace talus::campaign
