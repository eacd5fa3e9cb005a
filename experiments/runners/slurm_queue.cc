#include "experiments/runners/slurm_queue.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/joined.h"
#include "base/trimmed.h"
#include "experiments/runners/tool.h"

namespace talus::runners {
namespace {

std::vector<std::string> Columns(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, '|');) columns.push_back(cell);
  return columns;
}

// 0 for what is none, such as "INVALID" of a job that has not run.
double NumberOf(std::string_view text) {
  double number = 0;
  std::istringstream(std::string(text)) >> number;
  return number;
}

// sbatch takes a variable of the environment before the script's own line.
constexpr std::array<std::pair<std::string_view, const char*>, 10> kOverrides{
    {{"job-name", "SBATCH_JOB_NAME"},
     {"array", "SBATCH_ARRAY_INX"},
     {"output", "SBATCH_OUTPUT"},
     {"open-mode", "SBATCH_OPEN_MODE"},
     {"partition", "SBATCH_PARTITION"},
     {"account", "SBATCH_ACCOUNT"},
     {"qos", "SBATCH_QOS"},
     {"time", "SBATCH_TIMELIMIT"},
     {"mem", "SBATCH_MEM_PER_NODE"},
     {"requeue", "SBATCH_NO_REQUEUE"}}};

// `env` and what it is to take out of the environment, so that the script's lines hold. Squeue and
// scancel do not know SBATCH_CLUSTERS, and a submission that waits for its jobs would not return.
std::vector<std::string> WithoutOverrides(const std::string& script) {
  std::vector<std::string> command{"env", "--unset=SBATCH_CLUSTERS", "--unset=SBATCH_WAIT"};
  for (const auto& [option, variable] : kOverrides) {
    if (script.find("\n#SBATCH --" + std::string(option)) == std::string::npos) continue;
    command.push_back("--unset=" + std::string(variable));
  }
  return command;
}

}  // namespace

bool IsUnfinished(const SlurmState& state) {
  // A word that is not known is of a job that goes on: taken for ended it would run twice.
  constexpr std::array<std::string_view, 13> kEnded{
      kLost,           "BOOT_FAIL",     "CANCELLED", "COMPLETED",     "DEADLINE",
      "FAILED",        "LAUNCH_FAILED", "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED",
      "RECONFIG_FAIL", "REVOKED",       "TIMEOUT"};
  return std::find(kEnded.begin(), kEnded.end(), state.name) == kEnded.end();
}

bool IsWaiting(const SlurmState& state) {
  constexpr std::array<std::string_view, 8> kWaiting{
      "PENDING",     "CONFIGURING",  "POWER_UP_NODE", "REQUEUED",
      "REQUEUE_FED", "REQUEUE_HOLD", "RESV_DEL_HOLD", "SPECIAL_EXIT"};
  return std::find(kWaiting.begin(), kWaiting.end(), state.name) != kWaiting.end();
}

double ParseElapsed(std::string_view text) {
  constexpr double kDay = 86400;  // [s]
  const std::size_t dash = text.find('-');
  const bool has_days = dash != std::string_view::npos;
  const double days = has_days ? NumberOf(text.substr(0, dash)) : 0;
  double seconds = 0;
  std::istringstream parts{std::string(has_days ? text.substr(dash + 1) : text)};
  for (std::string part; std::getline(parts, part, ':');) seconds = 60 * seconds + NumberOf(part);
  return days * kDay + seconds;
}

SlurmState StateOf(const SlurmStates& states, const std::string& array, int task) {
  const auto own = states.find(array + "_" + std::to_string(task));
  if (own != states.end()) return own->second;
  const auto whole = states.find(array);
  if (whole != states.end()) return whole->second;
  const auto rest = states.lower_bound(array + "_[");
  if (rest != states.end() && rest->first.starts_with(array + "_[")) return rest->second;
  return {kLost, ""};
}

bool IsInQueue(const SlurmStates& states, const std::string& array) {
  return std::ranges::any_of(states, [&](const auto& known) {
    const auto& [job, state] = known;
    return (job == array || job.starts_with(array + "_")) && IsUnfinished(state);
  });
}

SlurmStates ParseSqueue(std::string_view output) {
  SlurmStates states;
  std::istringstream lines{std::string(output)};
  for (std::string line; std::getline(lines, line);) {
    const auto columns = Columns(line);
    if (columns.size() < 2) continue;
    states[columns[0]] = {columns[1], columns.size() > 2 ? columns[2] : "",
                          columns.size() > 3 ? ParseElapsed(columns[3]) : 0};
  }
  return states;
}

SlurmStates ParseSacct(std::string_view output) {
  SlurmStates states = ParseSqueue(output);
  for (auto& [job, state] : states) {
    state.elapsed = ParseElapsed(std::exchange(state.reason, ""));  // its third column
    // "CANCELLED by 1000"
    const std::size_t space = state.name.find(' ');
    if (space == std::string::npos) continue;
    state.reason = state.name.substr(space + 1);
    state.name.resize(space);
  }
  return states;
}

std::string ParseSubmitted(std::string_view output) {
  std::string job;
  std::istringstream lines{std::string(output)};
  for (std::string line; std::getline(lines, line);) {
    const std::string number = line.substr(0, line.find_first_not_of("0123456789"));
    if (!number.empty()) job = number;
  }
  return job;
}

SubmitReply SlurmQueue::Submit(const std::filesystem::path& script,
                               const std::filesystem::path& reply_file) const {
  std::vector<std::string> command = WithoutOverrides(base::ReadFile(script));
  command.insert(command.end(), {"sbatch", "--parsable", script.string()});
  const ToolResult result = RunTool(command, {.output_file = reply_file});
  SubmitReply reply;
  if (std::filesystem::exists(reply_file)) {
    reply.job = ParseSubmitted(base::ReadFile(reply_file));
  }
  if (!reply.job.empty()) return reply;
  reply.error = result.errors.empty() ? "sbatch gave no job number" : result.errors;
  for (const char* text : {"Unable to contact", "timed out", "temporarily", "no answer in time",
                           "Slurm backup controller in standby", "job submit limit",
                           "Zero Bytes were transmitted", "connection failure"}) {
    reply.try_again = reply.try_again || reply.error.find(text) != std::string::npos;
  }
  // Slurm says the same of a job that is too large: only one that others fill may have room later.
  if (reply.error.find("job submit limit") != std::string::npos && HasNoJobs()) {
    reply.try_again = false;
  }
  return reply;
}

bool SlurmQueue::HasNoJobs() const {
  const ToolResult queue = RunTool({"squeue", "--me", "--noheader", "--format=%i"});
  return queue.ok() && queue.output.find_first_not_of(" \n") == std::string::npos;
}

StatesReply SlurmQueue::States(const std::set<std::pair<std::string, int>>& tasks) const {
  // Its own user's jobs, not a list of numbers: squeue fails when one of them is forgotten.
  const ToolResult queue =
      RunTool({"squeue", "--me", "--states=all", "--noheader", "--array", "--format=%i|%T|%r|%M"});
  if (!queue.ok()) {
    const std::string said(base::Trimmed(queue.errors));
    return {.states = std::nullopt, .error = said.empty() ? "it gave no answer" : said};
  }
  SlurmStates states = ParseSqueue(queue.output);
  std::set<std::string> forgotten;  // arrays of which a task at least is
  for (const auto& [array, task] : tasks) {
    if (StateOf(states, array, task).name == kLost) forgotten.insert(array);
  }
  if (forgotten.empty()) return {.states = std::move(states), .error = {}};
  const ToolResult accounting =
      RunTool({"sacct", "--noheader", "--parsable2", "--allocations",
               "--format=JobID,State,Elapsed", "--jobs=" + base::Joined(forgotten, ",")});
  // A cluster without accounting: what squeue has forgotten nobody knows. What squeue says counts.
  if (accounting.ok()) states.merge(ParseSacct(accounting.output));
  return {.states = std::move(states), .error = {}};
}

std::string SlurmQueue::Find(const std::string& job_name) const {
  const ToolResult queue = RunTool({"squeue", "--me", "--states=all", "--noheader", "--array",
                                    "--name=" + job_name, "--format=%i|%T"});
  if (!queue.ok()) {
    throw base::Error("squeue does not say whether the job " + job_name +
                      " was submitted: " + queue.errors);
  }
  SlurmStates states = ParseSqueue(queue.output);
  if (states.empty()) {
    const ToolResult accounting =
        RunTool({"sacct", "--noheader", "--parsable2", "--allocations", "--name=" + job_name,
                 "--starttime=now-30days", "--format=JobID,State"});
    if (accounting.ok()) states = ParseSacct(accounting.output);
  }
  return states.empty() ? "" : ParseSubmitted(states.begin()->first);
}

void SlurmQueue::Cancel(const std::string& job) const { RunTool({"scancel", job}); }

}  // namespace talus::runners
