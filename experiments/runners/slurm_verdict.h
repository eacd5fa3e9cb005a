// What a job's final state in Slurm means for the campaign.
#pragma once

#include "experiments/runners/runner.h"
#include "experiments/runners/slurm_queue.h"

namespace talus::runners {

struct Verdict {
  JobEnd end = JobEnd::kExit;
  std::string reason;         // in words
  bool requeue = false;       // not the job's fault: it may run again
  bool await_result = false;  // the command has ended by itself; its folder will say how
};

// `log`: what Slurm has written about the job; a cluster that watches memory without cgroups says
// there, and nowhere else, that a job was over its limit. A cluster without accounting forgets a
// job some minutes after its end; the log still tells a limit of time or memory from a lost node.
Verdict VerdictOf(const SlurmState& state, const std::string& log);

}  // namespace talus::runners
