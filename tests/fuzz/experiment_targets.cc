#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "experiments/analysis/design/design_spec.h"
#include "experiments/analysis/next/test_candidate.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/checksums.h"
#include "experiments/journal/journal.h"
#include "experiments/journal/record_json.h"
#include "experiments/rigs/load_case.h"
#include "experiments/runners/slurm_batch.h"
#include "experiments/runners/slurm_queue.h"
#include "experiments/runners/slurm_verdict.h"
#include "experiments/trials/engines/command_scalars.h"
#include "experiments/trials/engines/template_text.h"
#include "experiments/trials/optimize/optimize_problem.h"
#include "tests/fuzz/targets.h"

namespace talus::fuzz {
namespace {

// Read and validated as any file is, but for what opens the files that it names.
template <class Options>
void Load(std::string_view bytes) {
  Expect([&] { base::LoadOptions<Options>(base::ParseJson(bytes, "file.json")); });
}

void Case(std::string_view bytes) {
  Expect([&] {
    const auto rig_case = base::LoadOptions<rigs::Case>(base::ParseJson(bytes, "case.json"));
    if (rig_case.powder.sizes.kind == engine::SizeKind::kFile) return;
    base::Problems problems;
    rigs::ValidateCase(rig_case, problems);
  });
}

void Candidates(std::string_view bytes) {
  Expect([&] { analysis::ReadTests(base::ParseJson(bytes, "candidates.json")); });
}

void Template(std::string_view bytes) {
  Expect([&] {
    const trials::TextTemplate text(bytes, "deck");
    const trials::TemplateValues values{.scalars = {{"a", "1"}}, .tables = {}};
    base::Problems problems;
    text.Check(values, problems);
    if (problems.empty()) text.Fill(values);
  });
}

void TrialFile(std::string_view bytes) {
  Expect([&] { journal::ParseRecord<journal::TrialRecord>(std::string(bytes), "trial.json"); });
}

// As another engine leaves them in either form.
void Scalars(std::string_view bytes) {
  Expect([&] { trials::ParseJsonScalars(std::string(bytes)); });
  Expect([&] { trials::ParseCsvScalars(std::string(bytes)); });
}

void ReadJournal(const std::filesystem::path& file) {
  Expect([&] {
    journal::Journal journal = journal::Journal::OpenReadOnly(file);
    journal.Campaign();
    journal.Progress();
    for (const journal::TrialRecord& trial : journal.Trials()) journal.ProfilePng(trial.id);
  });
}

// As it is, and with checksums that fit what it holds: damage does not get past them.
void JournalFile(std::string_view bytes) {
  static const std::filesystem::path file =
      std::filesystem::path("/dev/shm") / ("talus_fuzz_" + std::to_string(::getpid()) + ".sqlite");
  const auto remove = [] {
    for (const char* rest : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + rest);
  };
  Expect([&] {
    std::ofstream(file, std::ios::binary) << bytes;
    ReadJournal(file);
    {
      journal::Database database(file, journal::Database::Mode::kReadWrite);
      database.Execute("PRAGMA synchronous = OFF; BEGIN");
      journal::SealAll(database);
      database.Execute("COMMIT");
    }
    ReadJournal(file);  // not where it cannot be sealed: it is as before
  });
  remove();
}

void Slurm(std::string_view bytes) {
  const runners::SlurmStates states = runners::ParseSqueue(bytes);
  runners::VerdictOf(runners::StateOf(states, "1", 0), std::string(bytes));
  runners::ParseSacct(bytes);
  runners::ParseSubmitted(bytes);
  runners::ParseBatch(std::string(bytes));
}

constexpr Target kTargets[] = {{"spec", Load<campaign::CampaignSpec>},
                               {"case", Case},
                               {"experiment", Load<campaign::ExperimentSpec>},
                               {"candidates", Candidates},
                               {"design", Load<analysis::DesignSpec>},
                               {"problem", Load<trials::OptimizeProblem>},
                               {"template", Template},
                               {"scalars", Scalars},
                               {"trial_file", TrialFile},
                               {"journal", JournalFile},
                               {"slurm", Slurm}};

}  // namespace

std::span<const Target> ExperimentTargets() { return kTargets; }

}  // namespace talus::fuzz
