#include "experiments/runners/slurm_options.h"

namespace talus::experiments {

void SlurmOptions::Validate(base::Problems& problems) const {
  problems.Require(!time || *time > 0, "time", time.value_or(0), "must be positive");
  problems.Require(cores >= 1, "cores", cores, "must be at least 1");
  problems.Require(max_jobs >= 1, "max_jobs", max_jobs, "must be at least 1");
  problems.Require(poll_interval >= 5, "poll_interval", poll_interval,
                   "must be at least 5 s, so that the queue is not disturbed");
  problems.Require(result_delay >= 0, "result_delay", result_delay, "must not be negative");
  problems.Require(max_requeues >= 0, "max_requeues", max_requeues, "must not be negative");
  for (const std::string& line : directives) {
    problems.Require(line.starts_with("-") && line.find('\n') == std::string::npos, "directives",
                     "\"" + line + "\" must be an option of sbatch, such as --constraint=avx512");
  }
}

}  // namespace talus::experiments
