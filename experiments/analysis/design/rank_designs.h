// Which tests are expected to decide, before any is made: `talus next` with the searched ranges in
// place of a posterior, for one, two and three tests together.
#pragma once

#include <cstddef>
#include <vector>

#include "experiments/analysis/next/next_table.h"
#include "experiments/analysis/next/test_candidate.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

// Sets of each test: the ranges are wider than a posterior.
inline constexpr int kDesignSimulations = 32;

// Tests made together.
struct DesignChoice {
  std::vector<std::size_t> tests;  // of DesignTable::tests.candidates
  optimizer::ExpectedLearning learning;
  double remaining = 1;  // NextCandidate's
};

struct DesignTable {
  NextTable tests;  // each by itself, in the spec's order
  // Values of the parameters, SI, NaN where not given; empty: nothing is supposed.
  std::vector<double> supposed{};
  double scale_factor = 1;
  // Choices of one test, two, three: by size. First the most informative, or what leaves least of
  // a powder that is supposed.
  std::vector<std::vector<DesignChoice>> choices{};
};

// Simulates each test's design where that has not been done. `supposed` is taken for the powder's
// set, as far as it is given; empty: any set may be it. Throws base::Interrupted when the user ends
// it; what has ended is kept.
DesignTable RankDesigns(const campaign::JointView& view, const std::vector<TestCandidate>& tests,
                        const campaign::CampaignParts& parts,
                        const campaign::GivenSet& supposed = {});

}  // namespace talus::analysis
