// Whether another engine's deck can simulate a test: it simulates what its placeholders tell it,
// and what they do not tell stays as in the experiment that the deck was written for.
#pragma once

#include <string>

#include "experiments/campaign/answer/joint_view.h"
#include "experiments/rigs/case/case.h"

namespace talus::analysis {

// Why the campaign's engine would run its own experiment in place of the test: "the engine's
// templates have no {{ rig_kind }}, …". Empty where they take all that differs, where the engine is
// ours, and of a plan, whose deck is no experiment's.
std::string WhyNotByDeck(const campaign::JointView& view, const rigs::Case& test);

}  // namespace talus::analysis
