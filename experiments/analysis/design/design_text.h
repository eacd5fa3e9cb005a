// `talus design` in words: what it will cost on this machine, and the plan as a page to take to the
// laboratory, and for programs.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/design/design_spec.h"
#include "experiments/analysis/design/rank_designs.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// Before it is begun: a line for each test, and one for all. Simulates for about a second of
// processor time.
std::string DesignCostText(const DesignSpec& design);

// `tests` are those that were ranked.
std::string DesignText(const DesignTable& table, const campaign::JointView& view,
                       const std::vector<TestCandidate>& tests);
std::string DesignJson(const DesignTable& table);

}  // namespace talus::analysis
