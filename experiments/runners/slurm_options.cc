#include "experiments/runners/slurm_options.h"

#include "base/text/printable.h"

namespace talus::runners {

void SlurmOptions::Validate(base::Problems& problems) const {
  constexpr double kLongest = 366 * 86400.0;  // [s]
  problems.Require(!time || (*time > 0 && *time <= kLongest), "time", time.value_or(0),
                   "must be positive, and at most a year");
  problems.Require(cores >= 1, "cores", cores, "must be at least 1");
  problems.Require(max_jobs >= 1, "max_jobs", max_jobs, "must be at least 1");
  problems.Require(poll_interval >= 5, "poll_interval", poll_interval,
                   "must be at least 5 s, so that the queue is not disturbed");
  problems.Require(result_delay >= 0, "result_delay", result_delay, "must not be negative");
  problems.Require(max_requeues >= 0, "max_requeues", max_requeues, "must not be negative");
  // A blank would begin another option of sbatch, a line break another line of the script.
  const auto require_name = [&](const char* key, const std::string& name, const char* example) {
    const bool plain =
        name.find_first_not_of(
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.,:+@/-") ==
        std::string::npos;
    problems.Require(plain && !name.starts_with("-"), key,
                     "\"" + base::Printable(name) + "\" must be a name such as \"" + example +
                         "\": letters, digits and _ . , : + @ / -");
  };
  require_name("partition", partition, "short");
  require_name("account", account, "powder");
  require_name("qos", qos, "normal");
  require_name("memory", memory, "2G");
  const auto require_line = [&](const char* key, const std::string& line) {
    problems.Require(!base::HasControl(line), key,
                     "\"" + base::Printable(line) +
                         "\" has a line break or another control character; give each line apart");
  };
  for (const std::string& module : modules) require_line("modules", module);
  for (const std::string& line : setup) require_line("setup", line);
  for (const std::string& line : directives) {
    require_line("directives", line);
    problems.Require(line.starts_with("-"), "directives",
                     "\"" + base::Printable(line) +
                         "\" must be an option of sbatch, such as --constraint=avx512");
  }
}

}  // namespace talus::runners
