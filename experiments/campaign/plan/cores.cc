#include "experiments/campaign/plan/cores.h"

#include <algorithm>
#include <thread>

namespace talus::campaign {

int RanksOf(const CampaignSpec& spec) {
  return spec.engine.kind == EngineKind::kCommand ? spec.engine.command.ranks.value_or(1) : 1;
}

int CoresOfTrial(const CampaignSpec& spec) { return RanksOf(spec) * spec.threads; }

int LocalWorkers(const CampaignSpec& spec, int num_cores) {
  return spec.workers > 0 ? spec.workers : std::max(1, num_cores / CoresOfTrial(spec));
}

int MostAtATime(const CampaignSpec& spec, int num_cores) {
  if (spec.runner.kind == RunnerKind::kLocal) return LocalWorkers(spec, num_cores);
  const int most = spec.runner.slurm.max_jobs;
  return spec.workers > 0 ? std::min(most, spec.workers) : most;
}

int AtATime(const CampaignSpec& spec, int under_way) {
  if (spec.runner.kind != RunnerKind::kLocal) return under_way;
  return std::min(under_way, LocalWorkers(spec, NumCores()));
}

int CoresTaken(const CampaignSpec& spec, int under_way) {
  if (spec.runner.kind != RunnerKind::kLocal) return 0;
  return AtATime(spec, under_way) * CoresOfTrial(spec);
}

std::optional<std::string> CoresWarning(const CampaignSpec& spec, int num_cores) {
  if (spec.runner.kind != RunnerKind::kLocal) return std::nullopt;
  const int each = CoresOfTrial(spec);
  const int taken = LocalWorkers(spec, num_cores) * each;
  if (taken <= num_cores) return std::nullopt;
  const std::string trial =
      (RanksOf(spec) > 1 ? std::to_string(RanksOf(spec)) + " MPI ranks x " : "") +
      std::to_string(spec.threads) + (spec.threads == 1 ? " thread" : " threads");
  const std::string remedy = each <= num_cores
                                 ? "set \"workers\" to " + std::to_string(num_cores / each) +
                                       ", or to 0 for as many as fit"
                                 : "one trial alone is too many; set fewer ranks or threads";
  return "trials take " + std::to_string(taken) + " cores (" +
         std::to_string(LocalWorkers(spec, num_cores)) + " at a time x " + trial +
         "), and this machine has " + std::to_string(num_cores) + ": each waits for the others; " +
         remedy;
}

int NumCores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

}  // namespace talus::campaign
