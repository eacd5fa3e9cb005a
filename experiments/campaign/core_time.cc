#include "experiments/campaign/core_time.h"

#include <cmath>

#include "experiments/campaign/cores.h"

namespace talus::campaign {
namespace {

// 0 where it is not known.
double Measured(const journal::TrialRecord& trial, int num_cores) {
  if (trial.status == journal::TrialStatus::kRunning) return 0;
  const double seconds = trial.cpu_s > 0 ? trial.cpu_s : trial.duration_s * num_cores;
  return std::isfinite(seconds) ? seconds : 0;
}

}  // namespace

double GrainStepsOf(const CampaignSpec& spec, int experiment, double scale_factor) {
  const rigs::HeapSize size = rigs::EstimateHeap(TypicalCase(spec, experiment, scale_factor));
  return static_cast<double>(size.num_grains) * size.simulated_time / size.time_step;
}

double CoreTime::GrainSteps(const journal::TrialRecord& trial) {
  const Kind kind{trial.experiment, trial.scale_factor};
  const auto [entry, is_new] = grain_steps_.try_emplace(kind, 0);
  if (is_new) entry->second = GrainStepsOf(spec_, kind.first, kind.second);
  return entry->second;
}

double CoreTime::Estimate(const journal::TrialRecord& trial) {
  const auto same = measured_.find({trial.experiment, trial.scale_factor});
  if (same != measured_.end()) return same->second.seconds / same->second.count;
  double steps = 0;
  double seconds = 0;
  for (const auto& [kind, total] : measured_) {
    steps += grain_steps_.at(kind) * total.count;
    seconds += total.seconds;
  }
  return GrainSteps(trial) / (seconds > 0 ? steps / seconds : kUsualSpeed);
}

double CoreTime::Of(std::span<const journal::TrialRecord> trials) {
  measured_.clear();
  double sum = 0;
  for (const journal::TrialRecord& trial : trials) {
    const double seconds = Measured(trial, CoresOfTrial(spec_));
    if (seconds == 0) continue;
    GrainSteps(trial);
    Total& total = measured_[{trial.experiment, trial.scale_factor}];
    total.seconds += seconds;
    ++total.count;
    sum += seconds;
  }
  for (const journal::TrialRecord& trial : trials) {
    if (Measured(trial, CoresOfTrial(spec_)) == 0) sum += Estimate(trial);
  }
  return sum;
}

}  // namespace talus::campaign
