// Why a search ended: a kind with its data, put in words in one place.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "base/field.h"
#include "experiments/journal/records.h"
#include "optimizer/stop_reason.h"

namespace talus::campaign {

enum class StopKind {
  kRule,         // the strategy's own rule is met: `rule`
  kSimulations,  // the budget of `value` simulations is used
  kCoreTime,     // … of `value` seconds of core time
  kWallClock,    // … of `value` seconds of work
  kAllFailed,    // the first `value` trials, of all or of `experiment`, all failed; `cause` is what
                 // the last one did
  kUndefined,    // none of the first `value` trials defines the measured number `cause`
  kNothingLeft,  // the strategy has no more to propose
};
constexpr StopKind LastOf(StopKind) { return StopKind::kNothingLeft; }

struct Stop {
  StopKind kind = StopKind::kNothingLeft;
  double value = 0;
  std::optional<optimizer::StopReason> rule{};
  std::string cause{};  // a failed trial's own words, or the name of a number
  // Whose trials these are; empty where there is one experiment, or where all are meant.
  std::string experiment{};

  std::string Text() const;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind);
    visit("value", self.value);
    visit("rule", self.rule);
    visit("cause", self.cause);
    visit("experiment", self.experiment);
    std::string text = self.Text();  // for people; made anew wherever it is read
    visit("text", text);
  }
};

// So many failures and no success: the set-up is wrong.
inline constexpr std::size_t kFailuresToGiveUp = 8;

// The experiments that are set up wrongly: each of whose trials, kFailuresToGiveUp or more, have
// all failed, or every one where no trial at all has succeeded. Reused ones do not count: the
// set-up of others worked.
std::set<int> FailingExperiments(std::span<const journal::TrialRecord> trials);

}  // namespace talus::campaign
