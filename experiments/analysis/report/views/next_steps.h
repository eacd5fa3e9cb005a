// What would narrow the answer: from what the posterior's draws hold, for which no simulation is
// run, and from what `talus next` has found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/report/views/next_table_view.h"

namespace talus::analysis {

struct NextStep {
  std::string what;
  std::string cost;
  std::string leaves;  // what it is expected to leave, in words
  // Volume of the ranges after it / before, or of the goal's width; what the list is sorted by.
  // Below 0: before all others.
  double remaining = 1;
};

// The most useful first; nothing where there is neither a posterior nor a table. With a table its
// best candidates stand in place of guesses about photographs, tests and simulations.
std::vector<NextStep> NextSteps(const Evidence& evidence,
                                const std::optional<NextTableView>& table);

}  // namespace talus::analysis
