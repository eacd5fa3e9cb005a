// Sets to look at side by side: none is shown as fitting equally that no simulation shows to fit.
#pragma once

#include <vector>

#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/plan/planner.h"

namespace talus::campaign {

struct RepresentativeBasis {
  const optimizer::Answer& answer;  // with a posterior
  const Planner& planner;
  const Answer& result;  // with its parameters, experiments and confirmed sets
  double finest = 1;     // smallest scale factor of the search
};

// The recommended set between the ends of what fits equally, SI. An end stands there as it was
// simulated again, unless it misses a measurement; where none was, as the search has simulated it
// inside the joint 90 % region, nearer to the end than to the recommended set.
std::vector<std::vector<double>> Representatives(const RepresentativeBasis& basis);

}  // namespace talus::campaign
