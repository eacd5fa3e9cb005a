// A job array as it is written down before it is submitted: one shell script that is record and
// program in one, so that neither can be there without the other.
//
//   DIR/slurm/batch-000012.sh    the script; what it holds is read back by ParseBatch
//   DIR/slurm/batch-000012.job   what sbatch has answered: the array's job number
//   DIR/slurm/batch-000012-7.log what Slurm itself has to say of task 7; gone when that is nothing
//   DIR/slurm/batch-000012-7.cancelled  that we have cancelled task 7
//   DIR/slurm/batch-000012-7.forgotten  that task 7 has ended and counts no more
//   TRIAL/.slurm_end             written by the script when the command has ended
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runners/runner.h"
#include "experiments/runners/slurm_options.h"

namespace talus::runners {

struct Batch {
  std::int64_t number = 0;  // from 1, in the order of submission
  std::string job_name;     // unique to the batch: "talus-1f0c…-12"
  std::vector<Job> jobs;    // task k of the array runs jobs[k]
};

// `stem` is the script's path without its ending.
// Throws ConfigError for a control character, such as a line break, in a folder or a command: the
// shell or sbatch would read what follows it as a line of its own.
std::string BatchScript(const Batch& batch, const SlurmOptions& options,
                        const std::filesystem::path& stem);

std::filesystem::path TaskLog(const std::filesystem::path& stem, const std::string& task);

// Number, name and each job's id, attempt and folder; nothing if the text is not such a script.
std::optional<Batch> ParseBatch(const std::string& script);

// What the script leaves in the trial's folder.
struct TaskEnd {
  std::int64_t batch = 0;
  int task = 0;
  int status = 0;          // of the command, 128 + n when it was ended by signal n
  bool in_set_up = false;  // whether the set-up has ended the script, before the command began
  double duration = 0;     // [s] wall-clock
  double cpu_time = 0;     // [s]
  int restarts = 0;        // times that Slurm has requeued it
  std::string host;
};

// Nothing when there is no such file (yet), or not a whole one.
std::optional<TaskEnd> ReadTaskEnd(const std::filesystem::path& folder);

}  // namespace talus::runners
