#include "experiments/campaign/plan/usual_cost.h"

#include "experiments/rigs/load_case.h"

namespace talus::campaign {

double GrainStepsOf(const CampaignSpec& spec, int experiment, double scale_factor) {
  const rigs::CaseSize size = rigs::EstimateCase(TypicalCase(spec, experiment, scale_factor));
  return size.grain_time / size.time_step;
}

double CostAtUsualSpeed(const journal::TrialRecord& trial) {
  return static_cast<double>(trial.num_particles) * static_cast<double>(trial.num_steps) /
         kUsualSpeed;
}

void UsualCost::Add(int experiment, double scale_factor, double seconds) {
  if (!(seconds > 0)) return;
  Total& total = ended_[{experiment, scale_factor}];
  total.seconds += seconds;
  ++total.count;
}

double UsualCost::GrainSteps(const Kind& kind) {
  const auto [entry, is_new] = grain_steps_.try_emplace(kind, 0);
  if (is_new) entry->second = GrainStepsOf(spec_, kind.first, kind.second);
  return entry->second;
}

double UsualCost::Of(int experiment, double scale_factor) {
  const Kind asked{experiment, scale_factor};
  const auto same = ended_.find(asked);
  if (same != ended_.end()) return same->second.seconds / same->second.count;
  double steps = 0;
  double seconds = 0;
  for (const auto& [kind, total] : ended_) {
    steps += GrainSteps(kind) * total.count;
    seconds += total.seconds;
  }
  return GrainSteps(asked) / (seconds > 0 ? steps / seconds : kUsualSpeed);
}

}  // namespace talus::campaign
