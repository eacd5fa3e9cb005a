#include "experiments/campaign/run_cases.h"

#include <string>

#include "base/error.h"
#include "base/files/file.h"
#include "base/interrupt.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/record/trial_end.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

// A job in a queue goes on without this process; its name, beside its folder, finds it again.
fs::path NoteOf(const fs::path& folder) { return folder.string() + ".job"; }

// What a queue has of it is taken up before anything is written: it may still run in the folder.
bool TakeUp(const runners::Job& job, const FolderCase& run, const CampaignParts& parts) {
  if (!parts.engine->IsPrepared(run.rig_case, run.folder)) return false;
  const fs::path note = NoteOf(run.folder);
  runners::Job again = job;
  again.command = parts.engine->Command(run.folder);
  // The queue may have got it before the note was written.
  return parts.runner->Adopt(again, fs::exists(note) ? base::ReadFile(note) : "");
}

void Start(const runners::Job& job, runners::Runner& runner) {
  const std::string name = runner.Submit({&job, 1}).front();
  if (!name.empty()) base::WriteFileAtomically(NoteOf(job.folder), name);
}

constexpr const char* kMend = "; mend this, and the same command goes on";

// A set-up that starts nothing, or a disk that takes no files, is no failure of the case, and would
// be the next one's, too.
void StopIfSetUpFailed(const runners::FinishedJob& job, const fs::path& folder,
                       trials::TrialEngine& engine) {
  if (job.end == runners::JobEnd::kNotStarted) {
    throw base::Error(folder.string() + ": could not be started: " + FailureText(job, folder) +
                      kMend);
  }
  if (engine.IsComplete(folder)) return;
  RequireWritable(folder.parent_path());
  if (trials::LogSaysUnwritten(folder)) {
    throw base::Unwritten(folder.string() + ": " + FailureText(job, folder) + kMend);
  }
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
      runners::Job job{.id = static_cast<std::int64_t>(next),
                       .folder = run.folder,
                       .command = {},
                       .time_cap = runs.time_cap};
      if (engine.IsComplete(run.folder) || !TakeUp(job, run, parts)) {
        engine.Prepare(run.rig_case, run.folder);
        if (engine.IsComplete(run.folder)) {
          runs.has_ended(next - 1);
          continue;
        }
        job.command = engine.Command(run.folder);
        Start(job, *parts.runner);
      }
      ++running;
    }
    const double wait = running > 0 ? 0.5 : 0;  // [s]
    for (const runners::FinishedJob& job : parts.runner->Wait(wait)) {
      const auto index = static_cast<std::size_t>(job.id - 1);
      const fs::path folder = runs.at(index).folder;
      // The same call later simulates what has left no result.
      parts.runner->Forget({.id = job.id, .folder = folder, .command = {}});
      fs::remove(NoteOf(folder));
      StopIfSetUpFailed(job, folder, engine);
      runs.has_ended(index);
      --running;
    }
    if (interrupt.Asked() != base::Interrupt::kNone) return false;
  }
  return true;
}

}  // namespace talus::campaign
