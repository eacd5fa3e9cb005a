// What a search came to, as JSON: docs/optimize.md lists the keys.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/trials/optimize/optimize_problem.h"
#include "experiments/trials/optimize/search_tally.h"

namespace talus::trials {

// {"mu_t": 0.3, …} of a point of the unit cube.
nlohmann::ordered_json NativeParameters(const OptimizeProblem& problem,
                                        const Eigen::VectorXd& point);

nlohmann::ordered_json OptimizeResult(const OptimizeProblem& problem,
                                      const optimizer::Answer& answer, const SearchTally& tally,
                                      const std::string& stopped);

}  // namespace talus::trials
