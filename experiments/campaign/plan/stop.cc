#include "experiments/campaign/plan/stop.h"

#include <cmath>
#include <map>

#include "base/text/counted.h"
#include "base/text/duration_text.h"

namespace talus::campaign {

std::string Stop::Text() const {
  switch (kind) {
    case StopKind::kRule:
      return rule ? optimizer::TextOf(*rule) : "its own rule is met";
    case StopKind::kSimulations:
      return "the budget of " + base::Counted(std::llround(value), "simulation") + " is used";
    case StopKind::kCoreTime:
      return "the budget of " + base::DurationText(value) + " core time is used";
    case StopKind::kWallClock:
      return "the time budget of " + base::DurationText(value) + " is used";
    case StopKind::kAllFailed:
      return "the first " + std::to_string(std::llround(value)) + " trials" +
             (experiment.empty() ? "" : " of \"" + experiment + "\"") +
             " all failed, the last: " + cause;
    case StopKind::kUndefined:
      return "none of the first " + std::to_string(std::llround(value)) + " trials defines \"" +
             cause + "\", which was measured" +
             (experiment.empty() ? "" : " in \"" + experiment + "\"");
    case StopKind::kNothingLeft:
      break;
  }
  return "the strategy has no more to propose";
}

std::set<int> FailingExperiments(std::span<const journal::TrialRecord> trials) {
  struct Count {
    std::size_t failed = 0;
    bool has_succeeded = false;
  };
  std::map<int, Count> counts;
  Count of_all;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.kind == journal::TrialKind::kReused) continue;
    for (Count* count : {&counts[trial.experiment], &of_all}) {
      if (trial.status == journal::TrialStatus::kFailed) ++count->failed;
      if (trial.status == journal::TrialStatus::kOk) count->has_succeeded = true;
    }
  }
  const auto fails = [](const Count& count) {
    return count.failed >= kFailuresToGiveUp && !count.has_succeeded;
  };
  std::set<int> failing;
  for (const auto& [experiment, count] : counts) {
    if (fails(of_all) || fails(count)) failing.insert(experiment);
  }
  return failing;
}

}  // namespace talus::campaign
