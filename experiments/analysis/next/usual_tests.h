// The tests that most laboratories can make.
#pragma once

#include <vector>

#include "experiments/analysis/next/test_candidate.h"

namespace talus::analysis {

// Without those that the campaign has: a plate three times as wide as the tube at two lift
// velocities, a rough plate, tapped density, the collapse of a column, a tilting box, a shear cell,
// flow through an orifice, a heap from a funnel and a drum, each as large as the campaign's mass of
// powder fills well.
std::vector<TestCandidate> UsualTests(const campaign::JointView& view);

}  // namespace talus::analysis
