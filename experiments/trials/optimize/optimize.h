// The loop of `talus optimize`: ask, run the command, tell, and in the end say what it came to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/trials/optimize/optimize_problem.h"

namespace talus::trials {

struct OptimizeOutput {
  // Log, images and result; a search that was killed goes on from there. Nothing is kept when
  // empty.
  std::filesystem::path folder;
  bool quiet = false;  // no progress on standard error
};

struct OptimizeEnd {
  std::string result;        // the recommendation as JSON: docs/optimize.md lists the keys
  bool interrupted = false;  // by Ctrl-C: more could be asked
};

// Throws base::Interrupted after a second Ctrl-C or SIGTERM, which end the evaluations at once.
OptimizeEnd Optimize(const OptimizeProblem& problem, const std::vector<std::string>& command,
                     const OptimizeOutput& output);

}  // namespace talus::trials
