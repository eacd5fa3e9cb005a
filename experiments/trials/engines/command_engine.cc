#include "experiments/trials/engines/command_engine.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_changes.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/joined.h"
#include "base/version.h"
#include "engine/scene/size_distribution.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/runners/tool.h"
#include "experiments/trials/engines/case_values.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/engines/command_measure.h"
#include "experiments/trials/engines/command_result.h"
#include "experiments/trials/engines/command_scalars.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;
using base::Outlives;

constexpr const char* kKind = "command";
constexpr const char* kMpiLauncher = "mpirun";

// The checksum of the files that were measured: what the command left has no checksum of its own.
nlohmann::ordered_json ChecksumsOf(const std::vector<fs::path>& files, const fs::path& folder) {
  nlohmann::ordered_json checksums = nlohmann::ordered_json::object();
  for (const fs::path& file : files) {
    const fs::path inside = file.lexically_relative(folder);  // none of a part by another root
    const std::string name = (inside.empty() ? file : inside).string();
    checksums[name] = base::Hex(base::Checksum(base::ReadFile(file)));
  }
  return checksums;
}

// Whether the folder holds what was measured there, if it has been measured at all.
bool IsAsMeasured(const fs::path& folder) {
  if (!fs::exists(folder / rigs::kResultFile)) return true;
  try {
    const auto text =
        base::CheckedText(base::ReadFile(folder / rigs::kResultFile), rigs::kResultFile);
    if (!text) return false;
    const auto result = nlohmann::json::parse(*text, nullptr, false);
    if (!result.is_object() || !result.contains("measured")) return true;
    for (const auto& [name, checksum] : result["measured"].items()) {
      if (base::Hex(base::Checksum(base::ReadFile(folder / name))) != checksum) return false;
    }
    return true;
  } catch (const base::Error&) {
    return false;  // one of them is damaged or gone
  }
}

std::string ResultText(const rigs::Case& rig_case, const Measured& measured,
                       const fs::path& folder) {
  nlohmann::ordered_json result;
  result["kind"] = kKind;
  result["status"] = "ok";
  result["talus_version"] = base::Version();
  result["measured"] = ChecksumsOf(measured.files, folder);
  result["counts"] = {{"in_file", measured.num_spheres}, {"on_heap", measured.num_grains}};
  result["conditions"] = {{"scale_factor", rig_case.coarse_graining.scale_factor},
                          {"youngs_modulus_Pa", rig_case.powder.material.youngs_modulus},
                          {"lift_velocity_m_per_s", rig_case.rig.lifted_tube.lift_velocity},
                          {"seed", rig_case.seed}};
  for (const journal::MetricRecord& scalar : measured.scalars) {
    if (scalar.undefined.empty()) {
      result["observables"][scalar.name] = scalar.value;
    } else {
      result["undefined"][scalar.name] = scalar.undefined;
    }
  }
  if (rig_case.frame) {
    result["profile"] = base::ToJson(*rig_case.frame);
    result["profile"]["file"] = rigs::kProfileFile;
    result["profile"]["num_views"] = rigs::NumViewsOf(rig_case);
  }
  return base::WithChecksum(base::JsonText(result, 2) + "\n");
}

// What the placeholders mean: the case's values, and how the command is to run.
TemplateValues ValuesOf(const CommandOptions& options, const rigs::Case& rig_case) {
  TemplateValues values = CaseValues(rig_case);
  values.scalars["ranks"] = std::to_string(options.ranks.value_or(1));
  return values;
}

// The part that decides about a run: templates may lie elsewhere where they are the same.
nlohmann::ordered_json EngineJson(CommandOptions options) {
  if (!options.templates_hash.empty()) options.templates.reset();
  return base::ToJson(options);
}

// Whether the command is one process that `mpirun` starts as often as there are ranks. A command or
// a template that knows the number starts them itself.
bool IsLaunchedByUs(const CommandOptions& options, const TemplateFolder& templates) {
  return options.ranks.value_or(1) > 1 && !templates.Uses(options, "ranks");
}

void RequireTaken(const CommandOptions& options, const TemplateFolder& templates,
                  const SearchedParameter& searched, base::Problems& problems) {
  const std::vector<std::string> names = PlaceholdersOf(searched.name, searched.low, searched.high);
  const auto is_used = [&](const std::string& name) { return templates.Uses(options, name); };
  const std::vector<std::string> others(names.begin() + 1, names.end());
  problems.Require(
      std::ranges::any_of(names, is_used), "templates",
      options.templates->string() + ": no file has the placeholder {{ " + names.front() + " }}" +
          (others.empty()
               ? ""
               : ", nor another that follows from it (" + base::Joined(others, ", ") + ")") +
          ", so that searching " + searched.name + " would change nothing");
}

// Processor time of all that the command's shell has waited for, by the second line of `times`,
// "0m6.90s 0m0.10s"; 0 where it is not known [s].
double CpuTimeOf(const fs::path& mark) {
  std::ifstream in(mark);
  std::string own, children;
  if (!std::getline(in, own) || !std::getline(in, children)) return 0;
  double user_minutes = 0, user = 0, system_minutes = 0, system = 0;
  const int read = std::sscanf(children.c_str(), "%lfm%lfs %lfm%lfs", &user_minutes, &user,
                               &system_minutes, &system);
  return read == 4 ? 60 * (user_minutes + system_minutes) + user + system : 0;
}

}  // namespace

CommandEngine::CommandEngine(const CommandOptions& options, FormerFiles former)
    : options_(options), templates_(options.templates.value()), former_(former) {
  if (!options.templates_hash.empty() && options.templates_hash != templates_.Hash()) {
    throw base::ConfigError(options.templates->string() +
                            ": the templates are not those that it began with; put them back, or "
                            "begin another campaign or run");
  }
}

void CommandEngine::Prepare(const rigs::Case& rig_case, const fs::path& folder) {
  const std::string key = CaseText({.heap = rig_case, .engine = options_});
  if (former_ == FormerFiles::kRemove) {
    PrepareFolder(folder, rigs::kCaseFile, key);
  } else if (!HoldsKey(folder, rigs::kCaseFile, key)) {
    Forget(folder);
    for (const char* own : {rigs::kHeapFile, rigs::kProfileFile}) fs::remove(folder / own);
    base::WriteFileAtomically(folder / rigs::kCaseFile, key, Outlives::kProgram);
  }
  if (IsComplete(folder)) return;
  for (const char* ended : {rigs::kCommandDone, rigs::kResultFile}) fs::remove(folder / ended);
  RemoveResults(options_, folder);
  RemoveScalars(folder);
  if (former_ == FormerFiles::kRemove) RemoveFormer(folder);
  TemplateValues values = ValuesOf(options_, rig_case);
  if (templates_.Uses(options_, "grains")) AddGrains(rig_case, values);
  templates_.Fill(values, folder);
  std::vector<std::string> filled = FilledCommand(options_, values);
  if (IsLaunchedByUs(options_, templates_)) {
    filled.insert(filled.begin(), {kMpiLauncher, "-np", values.scalars["ranks"]});
  }
  const nlohmann::json command = filled;
  base::WriteFileAtomically(folder / rigs::kCommandFile, base::JsonText(command),
                            Outlives::kProgram);
}

bool CommandEngine::IsPrepared(const rigs::Case& rig_case, const fs::path& folder) {
  return HoldsKey(folder, rigs::kCaseFile, CaseText({.heap = rig_case, .engine = options_})) &&
         HasPrepared(folder);
}

std::vector<std::string> CommandEngine::Command(const fs::path& folder) {
  // The mark tells a result that is whole from one that a kill has left half written. What the
  // command took is put into it, where there is room. 127 is the shell's word for a command that is
  // not there, which ends the campaign; of one that is there it is a failure as any other. A signal
  // that ends the command ends the shell, so that the runner sees who was to blame.
  const std::string mark = rigs::kCommandDone;
  std::vector<std::string> command{
      "/bin/sh", "-c",
      "\"$@\" || { s=$?; [ $s = 127 ] && command -v \"$1\" >/dev/null && "
      "echo 'status 127: something that the command starts is not found' >&2 && s=1; "
      "[ $s -gt 128 ] && [ $s -le 192 ] && kill -$((s - 128)) $$; exit $s; }; "
      ": >" +
          mark + " || exit; LC_ALL=C; times >>" + mark + " || :",
      "sh"};
  const auto filled =
      nlohmann::json::parse(base::ReadFile(folder / rigs::kCommandFile), nullptr, false);
  for (const auto& argument : filled) {
    if (!argument.is_string()) {
      throw base::Error((folder / rigs::kCommandFile).string() + ": is damaged; remove the folder");
    }
    command.push_back(argument.get<std::string>());
  }
  return command;
}

bool CommandEngine::HasPrepared(const fs::path& folder) {
  return fs::exists(folder / rigs::kCommandFile);
}

void CommandEngine::Forget(const fs::path& folder) {
  std::error_code kept;  // where nothing can be written, nothing can be run again either
  fs::remove(folder / rigs::kCommandDone, kept);
}

bool CommandEngine::IsComplete(const fs::path& folder) {
  return fs::exists(folder / rigs::kCommandDone) && IsAsMeasured(folder);
}

TrialOutput CommandEngine::Collect(const rigs::Case& rig_case, const fs::path& folder) {
  Measured measured;
  try {
    measured = MeasureResult(options_, rig_case, folder);
  } catch (const base::Unwritten&) {  // a file of ours: what the command has left may be good
    throw;
  } catch (const base::Error&) {  // a full disk may have cut it off, and programs are mended
    Forget(folder);
    throw;
  }
  base::WriteFileAtomically(folder / rigs::kResultFile, ResultText(rig_case, measured, folder),
                            Outlives::kProgram);
  return {.profile = measured.profile,
          .num_steps = 0,
          .num_particles = static_cast<std::int64_t>(measured.num_spheres),
          .scalars = measured.scalars,
          .cpu_time = CpuTimeOf(folder / rigs::kCommandDone),
          .note = {},
          .doubt = measured.doubt};
}

// Collect draws spheres in the case's frame; an image of the command's own cannot be drawn anew.
std::optional<std::string> CommandEngine::WhyNotTaken(const rigs::Case& rig_case,
                                                      const fs::path& from) {
  const auto made = base::LoadOptions<CommandCase>(base::ReadJsonFile(from / rigs::kCaseFile));
  if (auto difference = rigs::RunDifference(made.heap, rig_case)) return difference;
  const auto engines = base::JsonChanges(EngineJson(made.engine), EngineJson(options_));
  if (!engines.empty() && engines.front().path == "templates_hash") {
    return "engine.templates holds other files there than here";
  }
  if (!engines.empty()) {
    return "engine." + engines.front().path + " is " + engines.front().before + " there and " +
           engines.front().after + " here";
  }
  rigs::Case heap = made.heap;
  heap.threads = rig_case.threads;
  if (auto difference =
          templates_.Difference(options_, ValuesOf(options_, heap), ValuesOf(options_, rig_case))) {
    return difference;
  }
  const bool same_frame = made.heap.frame == rig_case.frame;
  if (!same_frame && ResultOf(options_, from).extension() == ".png") {
    return "its engine has left images in another frame, which cannot be drawn anew";
  }
  return std::nullopt;
}

bool CommandEngine::TakeOver(const rigs::Case& rig_case, const fs::path& from, const fs::path& to) {
  if (WhyNotTaken(rig_case, from)) return false;
  CopyFolder(from, to);
  base::WriteFileAtomically(to / rigs::kCaseFile, CaseText({.heap = rig_case, .engine = options_}));
  return true;
}

void CheckCommand(const CommandOptions& options, const CommandCheck& check,
                  base::Problems& problems) {
  if (!fs::is_directory(options.templates.value())) {
    return problems.Add("templates", options.templates->string() +
                                         ": is no folder; name that of the engine's input files");
  }
  const TemplateFolder templates(*options.templates);
  const std::vector<std::string> stated = StatedPlaceholders(check.rig_case);
  templates.Check(options, ValuesOf(options, check.rig_case), stated, problems);
  for (const SearchedParameter& searched : check.searched) {
    if (std::ranges::find(stated, searched.name) != stated.end()) continue;
    RequireTaken(options, templates, searched, problems);
  }
  const std::string program = fs::path(options.command.front()).filename().string();
  const bool launches = program == kMpiLauncher || program == "mpiexec" || program == "srun";
  problems.Require(
      !launches || !IsLaunchedByUs(options, templates), "command",
      "begins with " + program +
          ", and would be started by mpirun once for each of the ranks; write {{ ranks "
          "}} where it takes their number, or leave it out");
  if (check.elsewhere) return;
  problems.Require(
      !IsLaunchedByUs(options, templates) || !runners::FindProgram(kMpiLauncher, {}).empty(),
      "ranks",
      std::string(kMpiLauncher) +
          " is not found, which is to start them; install an MPI, or start them yourself with "
          "{{ ranks }} in the command");
  problems.Require(
      !runners::FindProgram(options.command.front(), options.templates.value()).empty(), "command",
      "\"" + options.command.front() +
          "\" is not found, or not executable: neither on the PATH nor, if it has a "
          "\"/\", in the templates' folder");
}

}  // namespace talus::trials
