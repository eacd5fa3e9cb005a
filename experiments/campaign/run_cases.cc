#include "experiments/campaign/run_cases.h"

#include <string>

#include "base/files/file.h"
#include "base/interrupt.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

// A job in a queue goes on without this process; its name, beside its folder, finds it again.
fs::path NoteOf(const fs::path& folder) { return folder.string() + ".job"; }

void Start(const runners::Job& job, runners::Runner& runner) {
  const fs::path note = NoteOf(job.folder);
  if (fs::exists(note) && runner.Adopt(job, base::ReadFile(note))) return;
  const std::string name = runner.Submit({&job, 1}).front();
  if (!name.empty()) base::WriteFileAtomically(note, name);
}

}  // namespace

bool RunCases(const CaseRuns& runs, const CampaignParts& parts) {
  const base::InterruptGuard interrupt;
  return RunCases(runs, parts, interrupt);
}

bool RunCases(const CaseRuns& runs, const CampaignParts& parts,
              const base::InterruptGuard& interrupt) {
  trials::TrialEngine& engine = *parts.engine;
  std::size_t next = 0;
  int running = 0;
  while (next < runs.count || running > 0) {
    while (next < runs.count && running < parts.runner->Capacity()) {
      const FolderCase run = runs.at(next++);
      engine.Prepare(run.rig_case, run.folder);
      if (engine.IsComplete(run.folder)) {
        runs.has_ended(next - 1);
        continue;
      }
      Start({.id = static_cast<std::int64_t>(next),
             .folder = run.folder,
             .command = engine.Command(run.folder),
             .time_cap = runs.time_cap},
            *parts.runner);
      ++running;
    }
    for (const runners::FinishedJob& job : parts.runner->Wait(0.5)) {
      const auto index = static_cast<std::size_t>(job.id - 1);
      fs::remove(NoteOf(runs.at(index).folder));
      runs.has_ended(index);
      --running;
    }
    if (interrupt.Asked() != base::Interrupt::kNone) return false;
  }
  return true;
}

}  // namespace talus::campaign
