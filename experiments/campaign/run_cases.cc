#include "experiments/campaign/run_cases.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/files/file.h"
#include "base/interrupt.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/folder/time_taken.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/record/trial_end.h"
#include "experiments/rigs/case/run_files.h"

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

void KeepTime(const runners::FinishedJob& job, int num_cores, const fs::path& folder) {
  const double seconds = job.cpu_time > 0 ? job.cpu_time : job.duration * num_cores;
  KeepTimeTaken(folder, TimeTaken(folder) + std::max(0.0, seconds));
}

bool HasMark(const fs::path& folder) { return fs::exists(folder / rigs::kFailedFile); }

void Mark(const fs::path& folder) { base::WriteFileAtomically(folder / rigs::kFailedFile, ""); }

bool HasFailed(const FolderCase& run, trials::TrialEngine& engine) {
  return HasMark(run.folder) && engine.IsPrepared(run.rig_case, run.folder);
}

// What somebody else has ended says nothing of the case, and what met a limit may do with more.
bool IsFailure(const runners::FinishedJob& job) {
  const bool by_itself = job.end == runners::JobEnd::kExit || job.end == runners::JobEnd::kSignal;
  return by_itself && !WasEndedByOthers(job);
}

// What a complete case holds. One whose result is refused has failed as one that left none.
std::optional<trials::TrialOutput> Collect(const FolderCase& run, trials::TrialEngine& engine) {
  try {
    return engine.Collect(run.rig_case, run.folder);
  } catch (const base::Unwritten&) {
    throw;
  } catch (const base::Error&) {  // what it left says nothing
    if (!engine.IsComplete(run.folder)) Mark(run.folder);
    return std::nullopt;
  }
}

// Who is told of a case looks at what it has left, and may find it no good.
void TellEnd(const CaseRuns& runs, std::size_t index, trials::TrialEngine& engine) {
  const fs::path folder = runs.at(index).folder;
  const bool was_complete = engine.IsComplete(folder);
  runs.has_ended(index);
  if (was_complete && !engine.IsComplete(folder)) Mark(folder);
}

// Where none of the cases has succeeded the set-up is wrong, and what mends it need not change the
// cases: nothing is kept of their failures, however the call ends.
class FailuresOfSetUp {
 public:
  FailuresOfSetUp(const CaseRuns& runs, trials::TrialEngine& engine)
      : runs_(runs), engine_(engine) {}
  FailuresOfSetUp(const FailuresOfSetUp&) = delete;
  FailuresOfSetUp& operator=(const FailuresOfSetUp&) = delete;
  ~FailuresOfSetUp() {
    try {
      for (std::size_t i = 0; i < runs_.count; ++i) {
        const FolderCase run = runs_.at(i);
        if (engine_.IsComplete(run.folder) && Collect(run, engine_)) return;
      }
      for (std::size_t i = 0; i < runs_.count; ++i) {
        std::error_code ignored;
        fs::remove(runs_.at(i).folder / rigs::kFailedFile, ignored);
      }
    } catch (const std::exception&) {  // a disk that fails keeps what it has
    }
  }

 private:
  const CaseRuns& runs_;
  trials::TrialEngine& engine_;
};

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

CaseOutcome OutcomeOf(const FolderCase& run, trials::TrialEngine& engine) {
  CaseOutcome outcome{.core_time = TimeTaken(run.folder)};
  outcome.has_ended = engine.IsComplete(run.folder) || HasMark(run.folder);
  if (!engine.IsComplete(run.folder)) return outcome;
  try {
    outcome.output = Collect(run, engine);
  } catch (const base::Unwritten&) {  // a disk that is full
  }
  // An engine that goes on from a checkpoint says what all attempts took.
  if (outcome.output) outcome.core_time = std::max(outcome.core_time, outcome.output->cpu_time);
  return outcome;
}

bool RunCases(const CaseRuns& runs, const CampaignParts& parts) {
  const base::InterruptGuard interrupt;
  return RunCases(runs, parts, interrupt);
}

bool RunCases(const CaseRuns& runs, const CampaignParts& parts,
              const base::InterruptGuard& interrupt) {
  trials::TrialEngine& engine = *parts.engine;
  const FailuresOfSetUp failures(runs, engine);
  std::size_t next = 0;
  int running = 0;
  while (next < runs.count || running > 0) {
    while (next < runs.count && running < parts.runner->Capacity()) {
      const FolderCase run = runs.at(next++);
      if (HasFailed(run, engine)) {
        runs.has_ended(next - 1);
        continue;
      }
      runners::Job job{.id = static_cast<std::int64_t>(next),
                       .folder = run.folder,
                       .command = {},
                       .time_cap = runs.spec.trial_time_cap};
      if (engine.IsComplete(run.folder) || !TakeUp(job, run, parts)) {
        engine.Prepare(run.rig_case, run.folder);
        if (engine.IsComplete(run.folder)) {
          TellEnd(runs, next - 1, engine);
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
      parts.runner->Forget({.id = job.id, .folder = folder, .command = {}});
      fs::remove(NoteOf(folder));
      StopIfSetUpFailed(job, folder, engine);
      KeepTime(job, CoresOfTrial(runs.spec), folder);
      if (IsFailure(job) && !engine.IsComplete(folder)) Mark(folder);
      TellEnd(runs, index, engine);
      --running;
    }
    if (interrupt.Asked() != base::Interrupt::kNone) return false;
  }
  return true;
}

}  // namespace talus::campaign
