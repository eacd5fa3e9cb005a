// How a campaign uses a Slurm cluster (docs/clusters.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "base/text/printable.h"

namespace talus::runners {

inline constexpr double kYear = 366 * 86400.0;  // [s]: a longer limit is a slip of the unit

// Why talus sets this option of sbatch itself, and what to do instead; "" where it does not.
std::string OwnOptionOf(const std::string& directive);

struct SlurmOptions {
  std::string partition{};             // "": the cluster's default
  std::string account{};               // "": the user's default
  std::string qos{};                   // "": the user's default
  std::optional<double> time{};        // limit of a trial [s], > 0; default: the trial's time cap
  std::string memory{};                // of a trial, as Slurm writes it: "2G"; "": the default
  int cores = 1;                       // of each rank of a trial, >= 1
  int ranks = 1;                       // MPI processes of a trial, >= 1; the engine says how many
  std::vector<std::string> modules{};  // `module load`ed before the trial
  std::vector<std::string> directives{};  // more options of sbatch: "--constraint=avx512"
  std::vector<std::string> setup{};       // shell lines before the trial
  int max_jobs = 50;                      // waiting and running at the same time, >= 1
  double poll_interval = 5;               // [s] between two questions to Slurm, >= 5
  double result_delay = 60;               // [s] that a result may appear after the job's end, >= 0
  int max_requeues = 3;                   // after a node failure or preemption, >= 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("partition", self.partition, {.doc = "default: the cluster's"});
    visit("account", self.account, {.doc = "default: the user's"});
    visit("qos", self.qos, {.doc = "default: the user's"});
    visit("time", self.time,
          {.dimension = Dimension::kTime,
           .doc = "limit of a trial, > 0, rounded up to whole minutes; default: the trial's time "
                  "cap"});
    visit("memory", self.memory, {.doc = "of a trial, as Slurm writes it: 2G"});
    visit("cores", self.cores, {.doc = "of a trial, or of each of its MPI ranks, >= 1"});
    visit("modules", self.modules, {.doc = "loaded with `module load` before a trial"});
    visit("directives", self.directives, {.doc = "more options of sbatch: --constraint=avx512"});
    visit("setup", self.setup, {.doc = "shell lines to run before a trial"});
    visit("max_jobs", self.max_jobs, {.doc = "waiting and running at the same time, >= 1"});
    visit("poll_interval", self.poll_interval,
          {.dimension = Dimension::kTime, .doc = "between two questions to Slurm, >= 5 s"});
    visit("result_delay", self.result_delay,
          {.dimension = Dimension::kTime,
           .doc = "that the file system may take to show a result, >= 0"});
    visit("max_requeues", self.max_requeues,
          {.doc = "of a trial after a node failure or preemption, >= 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.Require(!time || (*time > 0 && *time <= kYear), "time", time.value_or(0),
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
      problems.Require(
          !base::HasControl(line), key,
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
      const std::string own = OwnOptionOf(line);
      problems.Require(own.empty(), "directives", "\"" + base::Printable(line) + "\" " + own);
    }
  }
  bool operator==(const SlurmOptions&) const = default;
};

}  // namespace talus::runners
