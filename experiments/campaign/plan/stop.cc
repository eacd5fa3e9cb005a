#include "experiments/campaign/plan/stop.h"

#include <cmath>

#include "experiments/trials/simulate/run_log.h"

namespace talus::campaign {

std::string Stop::Text() const {
  switch (kind) {
    case StopKind::kRule:
      return rule ? optimizer::TextOf(*rule) : "its own rule is met";
    case StopKind::kSimulations:
      return "the budget of " + std::to_string(std::llround(value)) + " simulations is used";
    case StopKind::kCoreTime:
      return "the budget of " + trials::DurationText(value) + " core time is used";
    case StopKind::kWallClock:
      return "the time budget of " + trials::DurationText(value) + " is used";
    case StopKind::kAllFailed:
      return "the first " + std::to_string(std::llround(value)) +
             " trials all failed, the last: " + cause;
    case StopKind::kUndefined:
      return "none of the first " + std::to_string(std::llround(value)) + " trials defines \"" +
             cause + "\", which was measured";
    case StopKind::kNothingLeft:
      break;
  }
  return "the strategy has no more to propose";
}

bool HaveFirstAllFailed(std::span<const journal::TrialRecord> trials) {
  std::size_t failed = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.kind == journal::TrialKind::kReused) continue;
    if (trial.status == journal::TrialStatus::kOk) return false;
    if (trial.status == journal::TrialStatus::kFailed) ++failed;
  }
  return failed >= kFailuresToGiveUp;
}

}  // namespace talus::campaign
