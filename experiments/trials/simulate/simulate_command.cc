#include "experiments/trials/simulate/simulate_command.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/files/file_lock.h"
#include "base/files/output_folder.h"
#include "base/interrupt.h"
#include "base/json/json_text.h"
#include "base/version.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/runners/local_runner.h"
#include "experiments/trials/engines/command_engine.h"
#include "experiments/trials/engines/template_folder.h"
#include "experiments/trials/simulate/run_lock.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

// The trial's own case.json, a template or a result could take the place of the user's file.
void RequireSourceElsewhere(const CommandFolderOptions& options) {
  if (options.source.empty()) return;
  std::error_code absent;
  const fs::path place = fs::absolute(options.source).parent_path();
  if (!fs::equivalent(place, options.folder, absent)) return;
  throw base::ConfigError(options.source.string() +
                          ": lies in the folder of the run, which could overwrite it; name another "
                          "folder with --out");
}

void RequireOwnFolder(const CommandCase& command_case, const CommandFolderOptions& options) {
  const fs::path& folder = options.folder;
  if (!fs::is_directory(folder) || fs::is_empty(folder)) return;
  const fs::path own = folder / rigs::kCaseFile;
  if (fs::exists(own) && base::ReadFile(own) == CaseText(command_case)) return;
  if (!CommandEngine::HasPrepared(folder)) {
    throw base::ConfigError(folder.string() +
                            ": holds other files, which a trial's folder may not; name another "
                            "with --out");
  }
  RequireSourceElsewhere(options);
  if (options.fresh) return;
  throw base::ConfigError(folder.string() +
                          ": holds the run of another case, or of templates that have changed "
                          "since; choose another --out, or --fresh to replace it");
}

// The campaign's process runs the command itself, and would find its files replaced.
void RequireNoLiveCampaign(const fs::path& folder) {
  std::error_code unreachable;  // which making it says
  const fs::path trials = fs::weakly_canonical(folder, unreachable).parent_path();
  if (trials.filename() != "trials") return;
  if (!base::IsLocked(trials.parent_path() / kCampaignLock)) return;
  throw base::Error(folder.string() +
                    ": another process works on the campaign whose trial this is; name another "
                    "--out, or wait");
}

void RunCommand(CommandEngine& engine, int threads, const fs::path& folder) {
  runners::LocalRunner runner({.workers = 1, .threads_per_job = threads});
  runners::Job job;
  job.folder = fs::absolute(folder);
  job.command = engine.Command(folder);
  runner.Submit({&job, 1});
  const base::InterruptGuard interrupt;
  std::vector<runners::FinishedJob> finished;
  bool is_asked = false;
  while (finished.empty()) {
    finished = runner.Wait(3600);
    if (is_asked || interrupt.Asked() == base::Interrupt::kNone) continue;
    is_asked = true;
    runner.Cancel(job.id);
  }
  if (is_asked) throw base::Interrupted("interrupted; the same command begins it anew");
  if (finished.front().ok()) return;
  const std::string log = LastLogLines(folder);
  throw base::Error("the command failed: " + finished.front().reason +
                    (log.empty() ? "" : "; its log ends with: " + log));
}

void WriteFailure(const fs::path& folder, const std::string& reason) {
  nlohmann::ordered_json result;
  result["kind"] = "command";
  result["status"] = "failed";
  result["talus_version"] = base::Version();
  result["reason"] = reason;
  base::WriteFileAtomically(folder / rigs::kResultFile,
                            base::WithChecksum(base::JsonText(result, 2) + "\n"));
}

}  // namespace

void SimulateCommandCase(const CommandCase& command_case, const CommandFolderOptions& options) {
  const fs::path& folder = options.folder;
  RequireOwnFolder(command_case, options);
  RequireOutside(command_case.engine, folder);
  RequireNoLiveCampaign(folder);
  CommandEngine engine(command_case.engine, FormerFiles::kKeep);
  base::MakeOutputFolder(folder);
  const RunLock lock(folder);
  if (options.fresh) engine.Forget(folder);
  engine.Prepare(command_case.heap, folder);
  const bool was_complete = engine.IsComplete(folder);
  TrialOutput output;
  try {
    if (!was_complete) RunCommand(engine, command_case.heap.threads, folder);
    output = engine.Collect(command_case.heap, folder);
  } catch (const base::Interrupted&) {
    throw;
  } catch (const base::Error& error) {
    WriteFailure(folder, error.what());
    throw base::Error(error.what());  // the input was good, whatever kind of error a result is
  }
  if (options.quiet) return;
  if (!output.doubt.empty()) std::cerr << "warning: " << output.doubt << '\n';
  std::cout << folder.string() << ": is done" << (was_complete ? " already" : "") << std::endl;
}

}  // namespace talus::trials
