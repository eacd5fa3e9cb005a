// The loop of `talus optimize`: ask, run the command, tell, and in the end say what it came to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/trials/optimize/optimize_problem.h"

namespace talus::experiments {

struct OptimizeOutput {
  std::filesystem::path log;  // one JSON object a line and evaluation; none when empty
  bool quiet = false;         // no progress on standard error
};

// The recommendation as JSON: docs/optimizers.md lists the keys.
std::string Optimize(const OptimizeProblem& problem, const std::vector<std::string>& command,
                     const OptimizeOutput& output);

}  // namespace talus::experiments
