// A plan as a page to take to the laboratory, and for programs.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/design/rank_designs.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// `tests` are those that were ranked.
std::string DesignText(const DesignTable& table, const campaign::JointView& view,
                       const std::vector<TestCandidate>& tests);
std::string DesignJson(const DesignTable& table);

}  // namespace talus::analysis
