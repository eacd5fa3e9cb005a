// What simulates a trial, and where.
#pragma once

#include "base/field.h"
#include "base/problems.h"
#include "experiments/runners/slurm_options.h"
#include "experiments/trials/engines/command_options.h"

namespace talus::campaign {

enum class EngineKind { kTalus, kCommand };
constexpr EngineKind LastOf(EngineKind) { return EngineKind::kCommand; }

struct EngineOptions {
  EngineKind kind = EngineKind::kTalus;
  trials::CommandOptions command;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind,
          {.doc = "talus: the engine of this program; command: another one, where the other keys "
                  "hold"});
    trials::CommandOptions::Visit(self.command, visit);
  }
  void Validate(base::Problems& problems) const {
    if (kind == EngineKind::kCommand) return command.Validate(problems);
    problems.Require(command == trials::CommandOptions(), "kind",
                     "is talus, for which the other keys say nothing; set it to command or leave "
                     "them out");
  }
};

enum class RunnerKind { kLocal, kSlurm };
constexpr RunnerKind LastOf(RunnerKind) { return RunnerKind::kSlurm; }

struct RunnerOptions {
  RunnerKind kind = RunnerKind::kLocal;
  runners::SlurmOptions slurm;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit(
        "kind", self.kind,
        {.doc = "local: processes of this machine; slurm: jobs of a cluster, where the other keys "
                "hold"});
    runners::SlurmOptions::Visit(self.slurm, visit);
  }
  void Validate(base::Problems& problems) const {
    if (kind == RunnerKind::kSlurm) return slurm.Validate(problems);
    problems.Require(slurm == runners::SlurmOptions(), "kind",
                     "is local, for which the other keys say nothing; set it to slurm or leave "
                     "them out");
  }
};

}  // namespace talus::campaign
