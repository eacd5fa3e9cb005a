#include "experiments/campaign/make_parts.h"

#include <algorithm>

#include "base/error.h"
#include "experiments/runners/local_runner.h"
#include "experiments/runners/slurm_runner.h"
#include "experiments/trials/engines/command_engine.h"
#include "experiments/trials/engines/talus_engine.h"

namespace talus::experiments {

std::unique_ptr<Runner> MakeRunner(const CampaignSpec& spec, const std::filesystem::path& folder) {
  switch (spec.runner.kind) {
    case RunnerKind::kLocal:
      return std::make_unique<LocalRunner>(
          LocalRunnerOptions{.workers = spec.workers, .threads_per_job = spec.threads});
    case RunnerKind::kSlurm: {
      SlurmOptions options = spec.runner.slurm;
      if (spec.workers > 0) options.max_jobs = std::min(options.max_jobs, spec.workers);
      options.cores = std::max(options.cores, spec.threads);
      return std::make_unique<SlurmRunner>(options, folder);
    }
  }
  throw base::Error("unknown kind of runner");
}

std::unique_ptr<TrialEngine> MakeEngine(const CampaignSpec& spec) {
  switch (spec.engine.kind) {
    case EngineKind::kTalus:
      return std::make_unique<TalusEngine>();
    case EngineKind::kCommand:
      return std::make_unique<CommandEngine>(spec.engine.command);
  }
  throw base::Error("unknown kind of engine");
}

}  // namespace talus::experiments
