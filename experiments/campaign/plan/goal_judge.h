// Looks at a campaign's goal while the search pauses.
#pragma once

#include <cstdint>
#include <optional>

#include "base/interrupt.h"
#include "experiments/campaign/folder/goal_folder.h"

namespace talus::campaign {

class GoalJudge {
 public:
  virtual ~GoalJudge() = default;

  // What the trials that are journalled say of it; simulates what that takes and keeps all of it in
  // DIR/goal. Nothing where the user ends it: the same call goes on.
  virtual std::optional<GoalState> Look(std::int64_t num_ended,
                                        const base::InterruptGuard& interrupt) = 0;
};

}  // namespace talus::campaign
