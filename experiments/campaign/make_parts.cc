#include "experiments/campaign/make_parts.h"

#include "base/error.h"
#include "experiments/engines/talus_engine.h"
#include "experiments/runners/local_runner.h"

namespace talus::experiments {

std::unique_ptr<Runner> MakeRunner(const CampaignSpec& spec, const std::filesystem::path&) {
  switch (spec.runner.kind) {
    case RunnerKind::kLocal:
      return std::make_unique<LocalRunner>(
          LocalRunnerOptions{.workers = spec.workers, .threads_per_job = spec.threads});
  }
  throw base::Error("unknown kind of runner");
}

std::unique_ptr<TrialEngine> MakeEngine(const CampaignSpec& spec) {
  switch (spec.engine.kind) {
    case EngineKind::kTalus:
      return std::make_unique<TalusEngine>();
  }
  throw base::Error("unknown kind of engine");
}

}  // namespace talus::experiments
