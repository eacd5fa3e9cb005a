// What would narrow the answer, from what the posterior's draws hold: no simulation is run for it.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

struct NextStep {
  std::string what;
  std::string cost;
  std::string leaves;    // what it is expected to leave, in words
  double remaining = 1;  // volume of the ranges after it / before; what the list is sorted by
};

// The most useful first; nothing where there is no posterior.
std::vector<NextStep> NextSteps(const Evidence& evidence);

}  // namespace talus::analysis
