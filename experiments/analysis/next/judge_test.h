// What a test would teach, from the simulations of its design.
#pragma once

#include "experiments/analysis/next/ground.h"
#include "experiments/analysis/next/next_table.h"
#include "experiments/analysis/next/test_design.h"
#include "experiments/analysis/next/unknown_moves.h"

namespace talus::analysis {

// A test as the table lists it before it is judged: `what` says how it is made, or why it cannot be
// simulated. `can_simulate` says which.
struct ListedTest {
  NextCandidate candidate;
  bool can_simulate = false;
};
ListedTest ListTest(const campaign::JointView& view, const TestCandidate& test);

// A test's simulations: its design, and those with one fixed thing moved; none where nothing was.
struct SimulatedTest {
  const TestCandidate& test;
  const TestDesign& design;
  const UnknownTrials& unknown;
};

// Fills in what is expected to be learnt, less what hangs on something unknown, and the two sets
// that the test tells apart best, and draws their picture; says in `what` why it cannot.
void JudgeTest(const Ground& ground, const SimulatedTest& simulated, NextCandidate& candidate);

}  // namespace talus::analysis
