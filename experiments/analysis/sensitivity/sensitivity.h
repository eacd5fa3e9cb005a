// What the answer owes to what was held fixed.
//
// One thing is moved at the recommended set, every experiment is simulated with it, and the shift δ
// of the outputs is what all simulations would show more: the answer is made anew, from the trials
// that there are. Replicates are doubled until it is told from the noise whether the answer moves
// beyond half of a range. Where it moves far, the set is simulated there, too, with the move and
// without, and the answer made anew of both shifts (shift_field.h) and of what was shown without.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/sensitivity/moves.h"
#include "experiments/analysis/sensitivity/sensitivity_table.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

struct SensitivityOptions {
  std::vector<std::pair<std::string, std::string>> moves{};  // name, value; none: the usual ones
  std::optional<double> scale_factor{};  // one of the campaign's; default: the coarsest
  int most_replicates = 16;              // of each experiment and move, >= kFirstReplicates
  // What all simulations may take, reckoned by the campaign's trials [s]. The first of each move
  // are made whatever they take; more replicates, and what is simulated at answers foretold, within
  // it.
  double core_time = std::numeric_limits<double>::infinity();
  campaign::CampaignParts parts{};
  std::function<void(const std::string&)> tell{};  // what goes on, a line each; may be empty
};

inline constexpr int kFirstReplicates = 4;

// Locks DIR/sensitivity while it simulates there. Throws base::Error while there are too few trials
// for a posterior, ConfigError where an option cannot be, with nothing written.
SensitivityTable FindSensitivity(const campaign::JointView& view,
                                 const SensitivityOptions& options);

// Processor time of its first simulations, which may be all [s].
double FirstCoreTime(const campaign::JointView& view, const SensitivityOptions& options);

}  // namespace talus::analysis
