// What a test would teach, from the simulations of its design.
#pragma once

#include "experiments/analysis/next/ground.h"
#include "experiments/analysis/next/next_table.h"
#include "experiments/analysis/next/test_design.h"

namespace talus::analysis {

// A test as the table lists it before it is judged: `what` says how it is made, or why it cannot be
// simulated. `can_simulate` says which.
struct ListedTest {
  NextCandidate candidate;
  bool can_simulate = false;
};
ListedTest ListTest(const campaign::JointView& view, const TestCandidate& test);

// Fills in what is expected to be learnt and the two sets that the test tells apart best, and draws
// their picture; says in `what` why it cannot.
void JudgeTest(const Ground& ground, const TestCandidate& test, const TestDesign& design,
               NextCandidate& candidate);

}  // namespace talus::analysis
