#include "experiments/campaign/spec/where_options.h"

namespace talus::campaign {

void EngineOptions::Validate(base::Problems& problems) const {
  if (kind == EngineKind::kCommand) {
    command.Validate(problems);
  } else {
    problems.Require(command == trials::CommandOptions(), "kind",
                     "is talus, for which the other keys say nothing; set it to command or leave "
                     "them out");
  }
}

void RunnerOptions::Validate(base::Problems& problems) const {
  if (kind == RunnerKind::kSlurm) {
    slurm.Validate(problems);
  } else {
    problems.Require(slurm == runners::SlurmOptions(), "kind",
                     "is local, for which the other keys say nothing; set it to slurm or leave "
                     "them out");
  }
}

}  // namespace talus::campaign
