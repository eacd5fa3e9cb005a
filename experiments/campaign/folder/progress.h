// What a campaign tells of itself while it runs, as data: for people it becomes a line, for scripts
// (--json) one JSON object a line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// A number that a trial gave of what was measured.
struct NumberProgress {
  std::string name{};  // with its unit: "angle_deg"
  double value = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("value", self.value);
  }
};

struct TrialProgress {
  std::int64_t trial = 0;
  journal::TrialKind kind = journal::TrialKind::kSearch;
  journal::TrialStatus status = journal::TrialStatus::kRunning;
  std::vector<std::string> parameters{};  // names of the free ones
  std::vector<double> values{};           // … in this order, native units
  double scale_factor = 1;
  std::string experiment{};               // its name
  std::optional<double> objective{};      // none where it is not defined
  std::string unit{};                     // of the objective, for people: "mm²"
  std::vector<NumberProgress> numbers{};  // those of the experiment that it has
  bool best = false;                      // the lowest objective so far, of the first
                                          // experiment at the smallest scale factor
  std::string reason{};                   // of a failure
  double duration = 0;                    // [s]

  static constexpr base::FieldKey kKeys[] = {{"duration", "duration_s"}};
  TALUS_FIELDS(trial, kind, status, parameters, values, scale_factor, experiment, objective, unit,
               numbers, best, reason, duration);
};

struct CampaignProgress {
  int num_search = 0;       // trials asked for, without the confirming ones
  int num_confirm = 0;      // … the confirming ones: the search has ended once there are any
  int budget = 0;           // of those of the search; 0: core time is the budget
  std::string used{};       // of the budget, for people
  double core_seconds = 0;  // used by the search, where that is the budget [s]
  std::optional<double> core_seconds_budget{};
  int num_running = 0;
  int num_waiting = 0;  // in a cluster's queue, beside those that run
  std::optional<double> best{};
  std::int64_t best_trial = 0;
  std::string unit{};
  std::optional<double> seconds_left{};  // at most

  static constexpr base::FieldKey kKeys[] = {{"best", "best_objective"}};
  TALUS_FIELDS(num_search, num_confirm, budget, core_seconds, core_seconds_budget, num_running,
               num_waiting, best, best_trial, unit, seconds_left);
};

// "trial 7 (search) at sliding_friction 0.3, rolling_friction 0.1: 1.2 mm², the best so far, 12 s"
std::string ProgressText(const TrialProgress& trial);

// "7 of 60 simulations, 2 running, best 1.2 mm² (trial 5), at most 3 min left"
std::string ProgressText(const CampaignProgress& campaign);

}  // namespace talus::campaign
