// What of a first spec follows from the rest of it: how coarse its grains are, and how many
// simulations its tests take.
#pragma once

#include <string>
#include <vector>

namespace talus::campaign {

struct DraftPlan {
  std::vector<double> scale_factors{1};  // the coarsest first
  bool is_held = false;  // coarser grains would not pass an opening of a test, or fit into a vessel
  int simulations = 60;
};

// `text` is the spec with any plan in it. One that cannot be read, which reading says why, has the
// plan of none.
DraftPlan PlanOf(const std::string& text);

}  // namespace talus::campaign
