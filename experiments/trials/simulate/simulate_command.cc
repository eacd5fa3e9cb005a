#include "experiments/trials/simulate/simulate_command.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/version.h"
#include "experiments/runners/local_runner.h"
#include "experiments/trials/engines/command_engine.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

void RequireOwnFolder(const CommandCase& command_case, const CommandFolderOptions& options) {
  const fs::path& folder = options.folder;
  if (!fs::exists(folder) || fs::is_empty(folder)) return;
  const fs::path own = folder / "case.json";
  if (fs::exists(own) && base::ReadFile(own) == CaseText(command_case)) return;
  if (!CommandEngine::HasPrepared(folder)) {
    throw base::ConfigError(folder.string() +
                            ": holds other files, which a trial's folder may not; name another "
                            "with --out");
  }
  if (options.fresh) return;
  throw base::ConfigError(folder.string() +
                          ": holds the run of another case, or of templates that have changed "
                          "since; choose another --out, or --fresh to replace it");
}

void RunCommand(CommandEngine& engine, int threads, const fs::path& folder) {
  runners::LocalRunner runner({.workers = 1, .threads_per_job = threads});
  runners::Job job;
  job.folder = fs::absolute(folder);
  job.command = engine.Command(folder);
  runner.Submit({&job, 1});
  std::vector<runners::FinishedJob> finished;
  while (finished.empty()) finished = runner.Wait(3600);
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
  base::WriteFileAtomically(folder / "result.json",
                            base::WithChecksum(base::JsonText(result, 2) + "\n"));
}

}  // namespace

void SimulateCommandCase(const CommandCase& command_case, const CommandFolderOptions& options) {
  const auto& [folder, fresh, quiet] = options;
  RequireOwnFolder(command_case, options);
  if (fresh) CommandEngine::Forget(folder);
  CommandEngine engine(command_case.engine, FormerFiles::kKeep);
  engine.Prepare(command_case.heap, folder);
  const bool was_complete = engine.IsComplete(folder);
  TrialOutput output;
  try {
    if (!was_complete) RunCommand(engine, command_case.heap.threads, folder);
    output = engine.Collect(command_case.heap, folder);
  } catch (const base::Error& error) {
    WriteFailure(folder, error.what());
    throw base::Error(error.what());  // the input was good, whatever kind of error a result is
  }
  if (quiet) return;
  if (!output.doubt.empty()) std::fprintf(stderr, "warning: %s\n", output.doubt.c_str());
  std::printf("%s: is done%s\n", folder.string().c_str(), was_complete ? " already" : "");
}

}  // namespace talus::trials
