// What a trial of an experiment at a scale factor usually costs: the mean of those that have ended,
// else by its grain steps.
#pragma once

#include <map>
#include <utility>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// Speed of a usual core [grain steps/s]. What trials are chosen by counts it in place of this
// machine's, so that equal specs and seeds make equal campaigns everywhere.
inline constexpr double kUsualSpeed = 4e7;

// Grain steps of a trial in the middle of the ranges.
double GrainStepsOf(const CampaignSpec& spec, int experiment, double scale_factor);

// What a trial that has ended would have taken at the usual speed [core seconds].
double CostAtUsualSpeed(const journal::TrialRecord& trial);

class UsualCost {
 public:
  explicit UsualCost(const CampaignSpec& spec) : spec_(spec) {}

  // A trial that has cost so much [core seconds]; nothing is known of one whose cost is 0.
  void Add(int experiment, double scale_factor, double seconds);
  void Clear() { ended_.clear(); }

  // [core seconds] Where none of its kind has ended, as many grain steps a second as the others
  // made, or kUsualSpeed.
  double Of(int experiment, double scale_factor);

 private:
  using Kind = std::pair<int, double>;  // experiment and scale factor
  struct Total {
    double seconds = 0;
    int count = 0;
  };

  double GrainSteps(const Kind& kind);

  const CampaignSpec& spec_;
  std::map<Kind, double> grain_steps_;
  std::map<Kind, Total> ended_;
};

}  // namespace talus::campaign
