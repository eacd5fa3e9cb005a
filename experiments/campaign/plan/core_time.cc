#include "experiments/campaign/plan/core_time.h"

#include <cmath>

#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/rigs/load_case.h"

namespace talus::campaign {

double MeasuredCoreTime(const journal::TrialRecord& trial, int num_cores) {
  const double seconds = trial.cpu_s > 0 ? trial.cpu_s : trial.duration_s * num_cores;
  return std::isfinite(seconds) ? seconds : 0;
}

double GrainStepsOf(const CampaignSpec& spec, int experiment, double scale_factor) {
  const rigs::CaseSize size = rigs::EstimateCase(TypicalCase(spec, experiment, scale_factor));
  return size.grain_time / size.time_step;
}

double CoreTime::GrainSteps(const Kind& kind) {
  const auto [entry, is_new] = grain_steps_.try_emplace(kind, 0);
  if (is_new) entry->second = GrainStepsOf(spec_, kind.first, kind.second);
  return entry->second;
}

double CoreTime::OfOne(int experiment, double scale_factor) {
  const Kind asked{experiment, scale_factor};
  const auto same = measured_.find(asked);
  if (same != measured_.end()) return same->second.seconds / same->second.count;
  double steps = 0;
  double seconds = 0;
  for (const auto& [kind, total] : measured_) {
    steps += grain_steps_.at(kind) * total.count;
    seconds += total.seconds;
  }
  return GrainSteps(asked) / (seconds > 0 ? steps / seconds : kUsualSpeed);
}

double CoreTime::Of(std::span<const journal::TrialRecord> trials) {
  measured_.clear();
  double sum = 0;
  for (const journal::TrialRecord& trial : trials) {
    const double seconds = MeasuredCoreTime(trial, CoresOfTrial(spec_));
    if (seconds == 0) continue;
    GrainSteps({trial.experiment, trial.scale_factor});
    Total& total = measured_[{trial.experiment, trial.scale_factor}];
    total.seconds += seconds;
    ++total.count;
    sum += seconds;
  }
  for (const journal::TrialRecord& trial : trials) {
    if (MeasuredCoreTime(trial, CoresOfTrial(spec_)) == 0)
      sum += OfOne(trial.experiment, trial.scale_factor);
  }
  return sum;
}

double CoreTime::OfSearch(std::vector<journal::TrialRecord> trials) {
  std::erase_if(trials, [](const journal::TrialRecord& trial) { return !IsPaidFor(trial); });
  return Of(trials);
}

double CoreTime::OfTold(std::vector<journal::TrialRecord> trials) {
  std::erase_if(trials, [](const journal::TrialRecord& trial) { return !IsOfSearch(trial); });
  return Of(trials);
}

}  // namespace talus::campaign
