#include "experiments/trials/engines/command_options.h"

namespace talus::experiments {

void CommandOptions::Validate(base::Problems& problems) const {
  problems.Require(templates.has_value(), "templates",
                   "is missing: the folder of the engine's input files");
  problems.Require(!command.empty() && !command.front().empty(), "command",
                   "must name a program and its arguments, such as [\"liggghts\", \"-in\", "
                   "\"in.heap\"]");
  problems.Require(!result.empty() && std::filesystem::path(result).is_relative(), "result",
                   "must be a file in the trial's folder, such as \"heap.*\"");
  problems.Require(!length_unit || *length_unit > 0, "length_unit", length_unit.value_or(0),
                   "must be positive");
}

}  // namespace talus::experiments
