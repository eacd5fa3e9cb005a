// What to do next, by what it is expected to teach about the parameters.
#pragma once

#include <vector>

#include "experiments/analysis/next/next_table.h"
#include "experiments/analysis/next/test_candidate.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

struct NextOptions {
  std::vector<TestCandidate> tests{};
  bool simulate = false;            // the designs of the tests that have none
  campaign::CampaignParts parts{};  // that simulate
};

// Throws base::Error while there are too few trials for a posterior.
NextTable RankNext(const campaign::JointView& view, const NextOptions& options);

}  // namespace talus::analysis
