// What a search came to, as JSON: docs/optimize.md lists the keys.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "experiments/trials/optimize/optimize_problem.h"

namespace talus::trials {

struct SearchTally {
  int num_evaluations = 0;
  int num_failed = 0;
  std::optional<optimizer::Observation> best;  // of the lowest value
};

// {"mu_t": 0.3, …} of a point of the unit cube.
nlohmann::ordered_json NativeParameters(const OptimizeProblem& problem,
                                        const Eigen::VectorXd& point);

nlohmann::ordered_json OptimizeResult(const OptimizeProblem& problem,
                                      const optimizer::Answer& answer, const SearchTally& tally,
                                      const std::string& stopped);

}  // namespace talus::trials
