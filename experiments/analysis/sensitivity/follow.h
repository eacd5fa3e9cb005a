// A move followed to where the answer goes with it.
//
// A shift depends on the set. Where the answer goes far, the set is simulated there, too, with the
// move and without, until it stays near one of the sets simulated. What they show without the move
// is told to a posterior of this move's own: a campaign knows least of the sets that did not fit.
#pragma once

#include <vector>

#include "experiments/analysis/sensitivity/move_shifts.h"
#include "experiments/analysis/sensitivity/sensitivity.h"
#include "experiments/analysis/sensitivity/stated_answer.h"

namespace talus::analysis {

// So many simulations as recommended for those of a move: common to all moves, more of them pay.
constexpr int BaseReplicates(int replicates) { return 2 * replicates; }

class Follower {
 public:
  // All outlive it. `core_time` is what is left of it [s], and falls by what is simulated.
  Follower(const SensitivitySetting& setting, const StatedAnswer& stated,
           const SensitivityOptions& options, double& core_time)
      : setting_(setting), stated_(stated), options_(options), core_time_(core_time) {}

  // From the answer foretold by simulations of the move at the recommended set.
  void Follow(const Move& move, FixedMove& foretold);

  // What was simulated for it.
  const Tally& tally() const { return tally_; }

 private:
  // A set at which the move was simulated.
  struct Place {
    Eigen::VectorXd point;  // unit cube
    SimulatedSet without;
    SimulatedSet with;
  };

  bool IsFar(const Eigen::VectorXd& next, const std::vector<Place>& places,
             const FixedMove& foretold) const;
  Place Simulate(const Move& move, const Eigen::VectorXd& point, const std::vector<MovedSet>& sets);
  std::vector<ShiftField> FieldsOf(const std::vector<Place>& places,
                                   const optimizer::Posterior& posterior,
                                   FixedMove& foretold) const;

  const SensitivitySetting& setting_;
  const StatedAnswer& stated_;
  const SensitivityOptions& options_;
  double& core_time_;
  Tally tally_{};
};

}  // namespace talus::analysis
