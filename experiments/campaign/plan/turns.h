// In which order trials that run side by side are told to the strategy: not as they end, which
// depends on the machine, but as they were expected to. So equal specs and seeds make equal
// campaigns, with as many trials at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "experiments/campaign/plan/usual_cost.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// Not in a queue, where a job may wait for hours: its trials are told as they end.
inline bool AreToldInTurn(const CampaignSpec& spec) {
  return spec.runner.kind == RunnerKind::kLocal;
}

// Trials that may have begun and not been told, where so many run at a time: the others wait, so
// that a core whose trial ends before its turn has another one to run. With none that wait a demo
// takes 7 to 28 % longer, with half as many as run 2 to 9 %, with so many 4 % at most
// (bench/idle_cores); the answer is as good (bench/optimizers/RECORD.md, Several grain sizes).
inline int MostBegun(const CampaignSpec& spec, int at_a_time) {
  return AreToldInTurn(spec) ? 2 * at_a_time - 1 : at_a_time;
}

// The running trial that is due first; nothing where none runs.
std::optional<std::int64_t> NextInTurn(std::span<const journal::TrialRecord> trials);

// The campaign's clock, which counts what trials were expected to cost [core seconds]. Its state
// follows from the trials that were told.
class Turns {
 public:
  explicit Turns(const CampaignSpec& spec) : usual_(spec) {}

  // TrialRecord::due of a trial that begins now.
  double DueOf(const journal::TrialRecord& trial) {
    return clock_ + usual_.Of(trial.experiment, trial.scale_factor);
  }

  void Told(const journal::TrialRecord& trial) {
    clock_ = std::max(clock_, trial.due);
    usual_.Add(trial.experiment, trial.scale_factor, CostAtUsualSpeed(trial));
  }

 private:
  UsualCost usual_;
  double clock_ = 0;
};

}  // namespace talus::campaign
