// What a campaign holds fixed, moved to another value that a laboratory may well have.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "experiments/rigs/case/case.h"

namespace talus::analysis {

struct Move {
  std::string name;  // "restitution", as the spec calls it
  std::string from;  // for people, with its unit
  std::string to;
  std::function<void(rigs::Case&)> apply;
  // By which another engine's templates take it, any of them; none: our engine alone knows it.
  std::vector<std::string> placeholders{};
};

// The usual ones: restitution, rolling damping, Young's modulus, the pairs of powder with plate and
// tube, the width of the sizes, mass, lift velocity, filling and options of the contact laws; each
// where it acts in `rig_case` and is not searched.
std::vector<Move> UsualMoves(const campaign::JointView& view, const rigs::Case& rig_case);

// Those of any of the experiments; of moves of one name the first.
std::vector<Move> UsualMoves(const campaign::JointView& view,
                             const std::vector<rigs::Case>& experiments);

// A parameter to a value of the user's, "restitution" and "0.6"; throws ConfigError where it is
// none, is searched, has that value or cannot have it.
Move MoveTo(const campaign::JointView& view, const rigs::Case& rig_case, const std::string& name,
            const std::string& value);

// Why the case, moved, cannot be simulated; empty where it can.
std::string WhyNotMoved(const Move& move, rigs::Case rig_case);

}  // namespace talus::analysis
