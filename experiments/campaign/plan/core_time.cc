#include "experiments/campaign/plan/core_time.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/campaign/plan/cores.h"

namespace talus::campaign {

namespace {

// Not one that had ended in a journal that was lost, and is to be told again.
bool IsRunning(const journal::TrialRecord& trial) {
  return trial.status == journal::TrialStatus::kRunning && trial.finished_utc.empty();
}

}  // namespace

double MeasuredCoreTime(const journal::TrialRecord& trial, int num_cores) {
  const double seconds = trial.cpu_s > 0 ? trial.cpu_s : trial.duration_s * num_cores;
  return std::isfinite(seconds) ? seconds : 0;
}

double MeasuredCoreTime(const journal::TrialRecord& trial, const CampaignSpec& spec) {
  const int num_cores = CoresOfTrial(spec);
  const double measured = MeasuredCoreTime(trial, num_cores);
  if (spec.runner.kind != RunnerKind::kSlurm || spec.engine.kind != EngineKind::kCommand) {
    return measured;
  }
  return std::isfinite(trial.duration_s) ? std::max(measured, trial.duration_s * num_cores)
                                         : measured;
}

double MeasuredCoreTime(std::span<const journal::TrialRecord> trials, const CampaignSpec& spec) {
  double sum = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (!IsRunning(trial) && trial.kind != journal::TrialKind::kReused) {
      sum += MeasuredCoreTime(trial, spec);
    }
  }
  return sum;
}

double CoreTime::Of(std::span<const journal::TrialRecord> trials) {
  usual_.Clear();
  double sum = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (IsRunning(trial)) continue;
    const double seconds = MeasuredCoreTime(trial, spec_);
    usual_.Add(trial.experiment, trial.scale_factor, seconds);
    sum += seconds;
  }
  for (const journal::TrialRecord& trial : trials) {
    const double measured = MeasuredCoreTime(trial, spec_);
    if (!IsRunning(trial) && measured > 0) continue;
    // What an earlier attempt at one that runs took is a part of it.
    sum += std::max(IsRunning(trial) ? measured : 0, OfOne(trial.experiment, trial.scale_factor));
  }
  return sum;
}

double CoreTime::OfSearch(std::vector<journal::TrialRecord> trials) {
  std::erase_if(trials, std::not_fn(&journal::TrialRecord::IsPaidFor));
  return Of(trials);
}

double CoreTime::OfTold(std::vector<journal::TrialRecord> trials) {
  std::erase_if(trials, std::not_fn(&journal::TrialRecord::IsOfSearch));
  return Of(trials);
}

}  // namespace talus::campaign
