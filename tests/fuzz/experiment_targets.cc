#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/file.h"
#include "base/json_reader.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/journal.h"
#include "experiments/journal/record_json.h"
#include "experiments/runners/slurm_batch.h"
#include "experiments/runners/slurm_queue.h"
#include "experiments/runners/slurm_verdict.h"
#include "experiments/trials/engines/template_text.h"
#include "experiments/trials/optimize/optimize_problem.h"
#include "tests/fuzz/targets.h"

namespace talus::fuzz {
namespace {

using namespace experiments;

// Read and validated as any file is, but for what opens the files that it names.
template <class Options>
void Load(std::string_view bytes) {
  Expect([&] { base::LoadOptions<Options>(base::ParseJson(bytes, "file.json")); });
}

void Template(std::string_view bytes) {
  Expect([&] {
    const TextTemplate text(bytes, "deck");
    const TemplateValues values{.scalars = {{"a", "1"}}, .tables = {}};
    base::Problems problems;
    text.Check(values, problems);
    if (problems.empty()) text.Fill(values);
  });
}

void TrialFile(std::string_view bytes) {
  Expect([&] { ParseRecord<TrialRecord>(std::string(bytes), "trial.json"); });
}

void JournalFile(std::string_view bytes) {
  static const std::filesystem::path file =
      std::filesystem::path("/dev/shm") / ("talus_fuzz_" + std::to_string(::getpid()) + ".sqlite");
  Expect([&] {
    base::WriteFileAtomically(file, bytes, base::Outlives::kProgram);
    Journal journal = Journal::OpenReadOnly(file);
    journal.Campaign();
    journal.Progress();
    journal.Trials();
    journal.Events();
  });
  std::filesystem::remove(file);
}

void Slurm(std::string_view bytes) {
  const SlurmStates states = ParseSqueue(bytes);
  VerdictOf(StateOf(states, "1", 0), std::string(bytes));
  ParseSacct(bytes);
  ParseSubmitted(bytes);
  ParseBatch(std::string(bytes));
}

constexpr Target kTargets[] = {{"spec", Load<CampaignSpec>},
                               {"case", Load<HeapCase>},
                               {"problem", Load<OptimizeProblem>},
                               {"template", Template},
                               {"trial_file", TrialFile},
                               {"journal", JournalFile},
                               {"slurm", Slurm}};

}  // namespace

std::span<const Target> ExperimentTargets() { return kTargets; }

}  // namespace talus::fuzz
