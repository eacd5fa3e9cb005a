// What a campaign holds fixed and nobody has measured, as far as `talus sensitivity` has moved it,
// in a test that could be made: moved in the middle one of the test's sets, in
// DIR/next/NAME/unknown.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/next/test_design.h"
#include "experiments/analysis/sensitivity/moves.h"

namespace talus::analysis {

// Moves of DIR/sensitivity.json that change this test; none where nothing was moved. Throws
// ConfigError on a damaged file.
std::vector<Move> UnknownMoves(const campaign::JointView& view, const TestCandidate& test,
                               const TestDesign& design);

// Simulations of a test with one thing moved.
struct MovedTest {
  std::string name;
  std::string from;  // for people, with its unit
  std::string to;
  std::vector<DesignTrial> trials;  // those that succeeded
};

struct UnknownTrials {
  std::vector<DesignTrial> base{};  // nothing moved
  std::vector<MovedTest> moved{};
  int num_missing = 0;   // simulations that have not ended
  double core_time = 0;  // of those that have [s]
};

// A test, its design, and what is moved in it.
struct MovedDesign {
  const TestCandidate& test;
  const TestDesign& design;
  const std::vector<Move>& moves;
};

// What there is of its simulations.
UnknownTrials StoredUnknowns(const campaign::JointView& view, const MovedDesign& moved,
                             trials::TrialEngine& engine);

// Simulates what of it is missing. Throws base::Interrupted when the user ends it.
UnknownTrials SimulateUnknowns(const campaign::JointView& view, const MovedDesign& moved,
                               const campaign::CampaignParts& parts);

}  // namespace talus::analysis
