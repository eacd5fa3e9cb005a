#include "experiments/campaign/make_parts.h"

#include <algorithm>

#include "base/error.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/runners/local_runner.h"
#include "experiments/runners/slurm_runner.h"
#include "experiments/trials/engines/command_engine.h"
#include "experiments/trials/engines/talus_engine.h"

namespace talus::campaign {

std::unique_ptr<runners::Runner> MakeRunner(const CampaignSpec& spec,
                                            const std::filesystem::path& folder) {
  switch (spec.runner.kind) {
    case RunnerKind::kLocal:
      return std::make_unique<runners::LocalRunner>(runners::LocalRunnerOptions{
          .workers = LocalWorkers(spec, NumCores()), .threads_per_job = spec.threads});
    case RunnerKind::kSlurm: {
      runners::SlurmOptions options = spec.runner.slurm;
      options.max_jobs = MostAtATime(spec, NumCores());
      options.cores = std::max(options.cores, spec.threads);
      options.ranks = RanksOf(spec);
      return std::make_unique<runners::SlurmRunner>(options, folder);
    }
  }
  throw base::Error("unknown kind of runner");
}

std::unique_ptr<trials::TrialEngine> MakeEngine(const CampaignSpec& spec) {
  switch (spec.engine.kind) {
    case EngineKind::kTalus:
      return std::make_unique<trials::TalusEngine>();
    case EngineKind::kCommand:
      return std::make_unique<trials::CommandEngine>(spec.engine.command);
  }
  throw base::Error("unknown kind of engine");
}

CampaignParts MakeParts(const CampaignSpec& spec, const std::filesystem::path& folder) {
  return {.runner = MakeRunner(spec, folder), .engine = MakeEngine(spec)};
}

}  // namespace talus::campaign
