#include "experiments/spec/where_options.h"

namespace talus::experiments {

void RunnerOptions::Validate(base::Problems& problems) const {
  if (kind == RunnerKind::kSlurm) {
    slurm.Validate(problems);
  } else {
    problems.Require(slurm == SlurmOptions(), "kind",
                     "is local, for which the other keys say nothing; set it to slurm or leave "
                     "them out");
  }
}

}  // namespace talus::experiments
