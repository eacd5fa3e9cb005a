// How the experiments of a campaign agree: what each answers alone, and whether what the others
// answer predicts one that is held out. From the trials there are; nothing is simulated.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"

namespace talus::campaign {

// A number that was measured beside what the other experiments predict of it.
struct PredictedNumber {
  std::string name;  // of the metric: "mass_fallen_kg"
  double low = 0;    // 5 % and 95 % of what is predicted to be measured
  double high = 0;
  double mean = 0;
  double measured = 0;
  double measured_sd = 0;

  bool IsInside() const { return measured >= low && measured <= high; }
};

struct HeldOut {
  std::string name;
  PartialAnswer others;             // what they answer without it
  double implausibility = 0;        // of the one held out at that answer [standard deviations]
  double least_implausibility = 0;  // over the others' joint 90 % region
  double predicted = std::numeric_limits<double>::quiet_NaN();  // objective of the mean image; NaN
  double predicted_sd = std::numeric_limits<double>::quiet_NaN();  // without images
  std::string objective_unit{};
  std::vector<PredictedNumber> numbers{};
};

// Throws ConfigError when the campaign has no experiment of this name or no other one.
HeldOut HoldOut(const JointView& view, const std::string& name);

// Each experiment by itself; those with too few trials are left out.
std::vector<PartialAnswer> AnswersAlone(const JointView& view);

std::string HeldOutText(const JointView& view, const HeldOut& held_out);
std::string HeldOutJson(const JointView& view, const HeldOut& held_out);
std::string AloneText(const JointView& view, const std::vector<PartialAnswer>& answers);
std::string AloneJson(const JointView& view, const std::vector<PartialAnswer>& answers);

}  // namespace talus::campaign
