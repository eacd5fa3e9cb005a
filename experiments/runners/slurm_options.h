// How a campaign uses a Slurm cluster (docs/clusters.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"

namespace talus::runners {

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
           .doc = "limit of a trial, > 0; default: the trial's time cap"});
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
  void Validate(base::Problems& problems) const;
  bool operator==(const SlurmOptions&) const = default;
};

}  // namespace talus::runners
