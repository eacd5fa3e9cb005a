#include "experiments/trials/simulate/run_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/cpu_time.h"
#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/interrupt.h"
#include "base/json/json_file.h"
#include "base/json/json_text.h"
#include "base/text/duration_text.h"
#include "base/version.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/trials/simulate/run_lock.h"
#include "experiments/trials/simulate/run_log.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheckpoint = "checkpoint.bin";

class Stopwatch {
 public:
  explicit Stopwatch(const engine::RunTiming& earlier) : earlier_(earlier) {}
  double Elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  engine::RunTiming Total() const {
    return {earlier_.wall_time + Elapsed(), earlier_.cpu_time + base::CpuTime()};
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  engine::RunTiming earlier_;
};

std::optional<nlohmann::json> ResultIn(const fs::path& folder) {
  if (!fs::exists(folder / rigs::kResultFile)) return std::nullopt;
  const auto result =
      nlohmann::json::parse(base::ReadFile(folder / rigs::kResultFile), nullptr, false);
  if (!result.is_object()) return std::nullopt;
  return result;
}

[[noreturn]] void RefuseFolder(const fs::path& folder, const char* what) {
  throw base::ConfigError(folder.string() + ": holds the " + what +
                          " of another input; choose another --out, or --fresh to replace it");
}

// True when the folder holds this input's result, undamaged.
bool IsDone(const RunJob& job, const fs::path& folder) {
  const auto result = ResultIn(folder);
  if (!result) return false;
  if (base::TextAt(*result, "input_hash") != base::Hex(job.input_hash)) {
    RefuseFolder(folder, "result");
  }
  return base::TextAt(*result, "status") == "ok" &&
         base::IfWhole(base::ReadFile(folder / rigs::kResultFile));
}

struct Started {
  std::unique_ptr<engine::Run> run;
  engine::RunTiming earlier;
  std::string message;
  bool goes_on = false;
};

Started StartOrGoOn(const RunJob& job, const RunFolderOptions& options, bool is_done) {
  const fs::path path = options.folder / kCheckpoint;
  std::string message;
  if (!options.fresh && !is_done && fs::exists(path)) {
    try {
      const engine::RunCheckpoint checkpoint =
          engine::Unpack(base::ReadFile(path, engine::kLargestCheckpoint));
      if (checkpoint.input_hash != job.input_hash) RefuseFolder(options.folder, "checkpoint");
      if (job.from_start) {
        throw base::ConfigError(path.string() +
                                ": would be lost, as a film begins with the filling; leave out "
                                "--film to go on from it, or choose another --out, or --fresh to "
                                "begin anew");
      }
      return {.run = job.go_on(checkpoint),
              .earlier = checkpoint.timing,
              .message = "goes on from " + path.string(),
              .goes_on = true};
    } catch (const base::ConfigError&) {
      throw;
    } catch (const base::Error& error) {  // the result is the same, only later
      message = path.string() + ": " + error.what() + "; begins anew";
    }
  }
  return {.run = job.start(), .earlier = {}, .message = message};
}

constexpr std::string_view kCommand = "simulate";

// A folder that is not ours keeps what it has, with --fresh too.
void RequireOwnFolder(const RunJob& job, const fs::path& folder) {
  std::error_code absent;
  const fs::path input = folder / job.input_name;
  if (base::IsOutputFolder(folder, kCommand)) return;
  if (fs::is_regular_file(input, absent) && base::ReadFile(input) == job.input) return;
  // What a campaign has put into a trial's folder, and the user's own input.
  std::vector<std::string_view> mine(rigs::kFilesOfCampaign.begin(), rigs::kFilesOfCampaign.end());
  const std::string source = job.source.filename();
  if (fs::equivalent(folder / source, job.source, absent)) mine.push_back(source);
  if (base::HoldsOnly(folder, mine)) return;
  throw base::ConfigError(folder.string() +
                          ": holds files that `talus simulate` has not written and could "
                          "overwrite; name a new folder with --out");
}

// "heap.vtp", "state_0001.vtp", "profile_2.png".
bool IsWrittenByRuns(const fs::path& file) {
  constexpr std::array kNames{rigs::kHeapFile,  "heap.csv",   rigs::kProfileFile,
                              "from_above.png", "film.gif",   "final.vtp",
                              "final.csv",      "series.csv", kCheckpoint};
  const std::string name = file.filename();
  if (std::ranges::find(kNames, name) != kNames.end()) return true;
  const fs::path ending = file.extension();
  return (name.starts_with("state_") && (ending == ".vtp" || ending == ".csv")) ||
         (name.starts_with("profile_") && ending == ".png");
}

// "checkpoint.bin.tmp6981": what a run was writing when it was killed. What a campaign writes into
// the folder of a trial is not ours.
bool IsHalfWritten(const fs::path& file) {
  constexpr std::string_view kMark = ".tmp";
  const std::string ending = file.extension();
  const fs::path whole = file.stem();
  return (IsWrittenByRuns(whole) || whole == rigs::kResultFile) && ending.starts_with(kMark) &&
         ending.size() > kMark.size() &&
         std::all_of(ending.begin() + kMark.size(), ending.end(),
                     [](unsigned char c) { return std::isdigit(c); });
}

void RemoveFormer(const RunJob& job, const fs::path& folder, bool anew) {
  std::vector<fs::path> former;
  std::error_code absent;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (!entry.is_regular_file() || fs::equivalent(file, job.source, absent)) continue;
    if (IsHalfWritten(file) || (anew && IsWrittenByRuns(file))) former.push_back(file);
  }
  for (const fs::path& file : former) fs::remove(file);
}

// What there is of a former result while a run simulates.
enum class Former { kGone, kGoneOn, kKept };

void PrepareFolder(const RunJob& job, const fs::path& folder, Former former) {
  RemoveFormer(job, folder, former == Former::kGone);
  base::WriteFileAtomically(folder / ".talus", std::string(kCommand) + "\n",
                            base::Outlives::kProgram);
  std::error_code absent;
  if (former != Former::kKept) fs::remove(folder / rigs::kResultFile, absent);
  const fs::path input = folder / job.input_name;
  const bool same = fs::equivalent(input, job.source, absent);  // the user's own is left as it is
  if (!same) base::WriteFileAtomically(input, job.input);
}

void WriteFailure(const RunJob& job, const fs::path& folder, const std::string& reason,
                  const Stopwatch& watch) {
  nlohmann::ordered_json result;
  result["kind"] = job.kind;
  result["status"] = "failed";
  result["reason"] = reason;
  result["talus_version"] = base::Version();
  result["input_hash"] = base::Hex(job.input_hash);
  result["timing"] = {{"wall_time_s", watch.Total().wall_time},
                      {"cpu_time_s", watch.Total().cpu_time}};
  base::WriteFileAtomically(folder / rigs::kResultFile,
                            base::WithChecksum(base::JsonText(result, 2) + "\n"));
}

void Report(engine::Run& run, RunLog& log) {
  for (const std::string& message : run.TakeMessages()) log.Line(message);
}

std::string InterruptedText(const RunJob& job, const fs::path& checkpoint, Former former) {
  if (former == Former::kKept) {
    return "interrupted; the folder keeps the result that it had, and the same command begins the "
           "film anew";
  }
  if (!job.from_start) return "interrupted; the same command goes on from " + checkpoint.string();
  return "interrupted; with --film and --fresh the same command begins anew, without them it goes "
         "on from " +
         checkpoint.string();
}

// Slices until the end, with checkpoints in between; none beside a result that is kept.
void Loop(const RunJob& job, engine::Run& run, const RunFolderOptions& options,
          const Stopwatch& watch, RunLog& log, Former former) {
  const fs::path checkpoint = options.folder / kCheckpoint;
  const base::InterruptGuard interrupt;
  const auto save = [&] {
    if (former == Former::kKept) return;
    base::WriteFileAtomically(checkpoint, run.Checkpoint(watch.Total()));
  };
  double saved = 0;
  job.look(run);
  while (run.Advance()) {
    job.look(run);
    Report(run, log);
    log.Progress(run.Progress());
    if (interrupt.Asked() != base::Interrupt::kNone) {
      save();
      throw base::Interrupted(InterruptedText(job, checkpoint, former));
    }
    if (job.checkpoint_interval > 0 && watch.Elapsed() - saved > job.checkpoint_interval) {
      save();
      saved = watch.Elapsed();
    }
  }
  job.look(run);
  Report(run, log);
}

std::string Summary(const engine::RunProgress& end, const engine::RunTiming& timing) {
  char text[160];
  std::snprintf(text, sizeof text, "done: %lld steps, %.4f s simulated, %s, %.1f Mps/s",
                static_cast<long long>(end.step), end.time,
                base::DurationText(timing.wall_time).c_str(),
                end.particle_steps / timing.wall_time / 1e6);
  return text;
}

}  // namespace

void DriveRun(const RunJob& job, const RunFolderOptions& options) {
  const fs::path& folder = options.folder;
  RequireOwnFolder(job, folder);
  base::MakeOutputFolder(folder);
  const RunLock lock(folder);
  const bool is_done = !options.fresh && IsDone(job, folder);
  if (is_done && !job.from_start) {
    RunLog(folder, options.quiet).Line(folder.string() + ": is done already");
    return;
  }
  Started started = StartOrGoOn(job, options, is_done);
  const Former former = is_done ? Former::kKept : started.goes_on ? Former::kGoneOn : Former::kGone;
  PrepareFolder(job, folder, former);
  RunLog log(folder, options.quiet);
  const Stopwatch watch(started.earlier);
  if (!started.message.empty()) log.Line(started.message);
  if (started.goes_on && !job.lost_at_checkpoint.empty()) log.Line(job.lost_at_checkpoint);
  try {
    Loop(job, *started.run, options, watch, log, former);
    job.write();
    started.run->WriteResults(watch.Total());
  } catch (const base::Interrupted&) {
    throw;
  } catch (const base::Unwritten& error) {  // no result of the case: it is simulated again
    log.Line(std::string("failed: ") + error.what());
    throw;
  } catch (const base::Error& error) {
    WriteFailure(job, folder, error.what(), watch);
    log.Line(std::string("failed: ") + error.what());
    throw;
  }
  log.Line(Summary(started.run->Progress(), watch.Total()));
  std::error_code gone;
  fs::remove(folder / kCheckpoint, gone);
}

}  // namespace talus::trials
