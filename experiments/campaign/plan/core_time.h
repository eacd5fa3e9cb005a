// What trials cost in processor time: as measured once they have ended, as estimated before.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// Speed of a usual core [grain steps/s]. Estimates that a strategy is told use it rather than the
// speed of this machine, so that equal specs and seeds make equal proposals everywhere.
inline constexpr double kUsualSpeed = 4e7;

// Grain steps of a trial in the middle of the ranges.
double GrainStepsOf(const CampaignSpec& spec, int experiment, double scale_factor);

// Processor time of a trial that has ended [core seconds]; 0 where it is not known.
double MeasuredCoreTime(const journal::TrialRecord& trial, int num_cores);

class CoreTime {
 public:
  explicit CoreTime(const CampaignSpec& spec) : spec_(spec) {}

  // [core seconds] of all these trials: those that run still count by what others of their
  // experiment and scale factor took.
  double Of(std::span<const journal::TrialRecord> trials);
  // Noise and search among them, without what was reused.
  double OfSearch(std::vector<journal::TrialRecord> trials);
  // The same with what was reused: what it takes to know as much.
  double OfTold(std::vector<journal::TrialRecord> trials);

  // The time of one more simulation, by what the trials of the last Of took.
  double OfOne(int experiment, double scale_factor);

 private:
  using Kind = std::pair<int, double>;  // experiment and scale factor

  double GrainSteps(const Kind& kind);

  const CampaignSpec& spec_;
  std::map<Kind, double> grain_steps_;
  struct Total {
    double seconds = 0;
    int count = 0;
  };
  std::map<Kind, Total> measured_;
};

}  // namespace talus::campaign
