// What to do next, by what it is expected to teach about the parameters or a prediction.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/next/goal.h"
#include "experiments/analysis/next/next_table.h"
#include "experiments/analysis/next/test_candidate.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

struct NextOptions {
  std::vector<TestCandidate> tests{};
  bool simulate = false;  // the designs of the tests that have none, the cheapest first
  // … as long as the next one fits within this core time [s]
  double core_time = std::numeric_limits<double>::infinity();
  bool is_in_all = false;  // what the stored ones have taken is a part of it
  // Told before a design is simulated.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  campaign::CampaignParts parts{};  // that simulate
  std::optional<Goal> goal{};       // ranked by how much they narrow it, not by bits
};

// Throws base::Error while there are too few trials for a posterior.
NextTable RankNext(const campaign::JointView& view, const NextOptions& options);

}  // namespace talus::analysis
