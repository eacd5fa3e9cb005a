#include "experiments/trials/optimize/optimize_problem.h"

namespace talus::trials {

void OptimizeTarget::Validate(base::Problems& problems) const {
  problems.Require(profile.empty() != field.empty(), "profile",
                   "must be given, or \"field\", but not both");
  for (std::size_t row = 0; row < field.size(); ++row) {
    const std::string path = "field[" + std::to_string(row) + "]";
    problems.Require(!field[row].empty() && field[row].size() == field.front().size(), path,
                     "must be as long as the first row, and not empty");
    for (const double pixel : field[row]) {
      problems.Require(pixel >= 0 && pixel <= 1, path, pixel, "must be in [0, 1]");
    }
  }
}

void OptimizeProblem::Validate(base::Problems& problems) const {
  space.Validate(problems);
  for (std::size_t i = 0; i < space.parameters.size(); ++i) {
    problems.Require(space.parameters[i].name != "seed",
                     "parameters[" + std::to_string(i) + "].name",
                     "must not be \"seed\": the command is given one under that name");
  }
  problems.Within("strategy", [&] {
    strategy.ValidateUse(false, problems);
    const auto num_parameters = static_cast<int>(space.Free().size());
    strategy.ValidateFor(num_parameters, space.IsContinuous(), problems);
    // Constraints may leave fewer points than the grid has.
    if (space.constraints.empty()) strategy.ValidateGrid(num_parameters, evaluations, problems);
  });
  problems.Require(evaluations >= 1, "evaluations", evaluations, "must be at least 1");
  problems.RequireFromTo("workers", workers, 1, 8);
  problems.Require(time_cap > 0, "time_cap", time_cap, "must be positive");
}

}  // namespace talus::trials
