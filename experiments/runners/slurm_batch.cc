#include "experiments/runners/slurm_batch.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/text/printable.h"
#include "base/text/shell_text.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::runners {
namespace {

constexpr const char* kRecord = "#talus ";

// In double quotes, as sbatch reads its own lines; a percent sign would begin a pattern.
std::string QuotedForSbatch(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '%' ? std::string("%%") : std::string(1, c);
  }
  return quoted + '"';
}

void RequirePlain(const std::string& what, const std::string& text) {
  if (!base::HasControl(text)) return;
  throw base::ConfigError(what + " \"" + base::Printable(text) +
                          "\" has a line break or another control character, which a script for "
                          "Slurm cannot hold; take it out");
}

void RequirePlain(const Batch& batch, const std::filesystem::path& stem) {
  RequirePlain("the folder", stem.string());
  for (const Job& job : batch.jobs) {
    RequirePlain("the folder", job.folder.string());
    for (const std::string& argument : job.command) RequirePlain("the argument", argument);
  }
}

// sbatch counts in whole minutes.
long Minutes(const Batch& batch, const SlurmOptions& options) {
  double seconds = options.time.value_or(0);
  if (!options.time) {
    for (const Job& job : batch.jobs) seconds = std::max(seconds, job.time_cap);
  }
  return std::lround(std::ceil(seconds / 60));
}

void AddDirectives(std::ostream& out, const Batch& batch, const SlurmOptions& options,
                   const std::filesystem::path& stem) {
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) out << "#SBATCH --" << name << '=' << value << '\n';
  };
  add("job-name", batch.job_name);
  add("array", "0-" + std::to_string(batch.jobs.size() - 1));
  const std::string log = QuotedForSbatch(TaskLog(stem, "").string());  // "…/batch-000001-.log"
  add("output", log.substr(0, log.size() - 5) + "%a.log\"");
  add("open-mode", "append");
  add("partition", options.partition);
  add("account", options.account);
  add("qos", options.qos);
  const long minutes = Minutes(batch, options);
  if (minutes > 0) add("time", std::to_string(minutes));
  add("mem", options.memory);
  add("ntasks", std::to_string(options.ranks));
  add("cpus-per-task", std::to_string(options.cores));
  out << "#SBATCH --requeue\n";
  for (const std::string& line : options.directives) out << "#SBATCH " << line << '\n';
}

void AddJobs(std::ostream& out, const Batch& batch) {
  out << "task=${SLURM_ARRAY_TASK_ID:-0}\ncase $task in\n";
  for (std::size_t task = 0; task < batch.jobs.size(); ++task) {
    const Job& job = batch.jobs[task];
    out << task << ") folder=" << base::ShellQuoted(job.folder.string()) << "; command=(";
    for (const std::string& argument : job.command) out << ' ' << base::ShellQuoted(argument);
    out << " ) ;;\n";
  }
  out << "*) exit 1 ;;\nesac\n";
}

constexpr const char* kInSetUp = "set-up";  // last word of a task's end that its set-up has made
constexpr const char* kOfCommand = "end";   // … that its command has made

// Functions of the script: the time [µs], also with a bash before version 5, and the file that says
// how a task has ended: its status, its time [µs], its processor time [ms], and in what.
void AddEnd(std::ostream& out, const Batch& batch) {
  out << "now() {\n"
      << "  if [ -n \"$EPOCHREALTIME\" ]; then echo \"${EPOCHREALTIME//[!0-9]/}\"\n"
      << "  else echo $(($(date +%s%N) / 1000)); fi\n"
      << "}\n"
      << "write_end() {\n"
      << "  cd \"$folder\" || return\n"  // the set-up may have gone elsewhere
      << "  echo " << batch.number
      << " $task $1 $2 $3 ${SLURM_RESTART_COUNT:-0} ${HOSTNAME:-unknown} $4 >" << rigs::kTaskEndPart
      << "\n"
      << "  mv " << rigs::kTaskEndPart << ' ' << rigs::kTaskEndFile << "\n"
      << "}\n";
}

}  // namespace

std::string BatchScript(const Batch& batch, const SlurmOptions& options,
                        const std::filesystem::path& stem) {
  RequirePlain(batch, stem);
  std::ostringstream out;
  out << "#!/bin/bash\n";
  AddDirectives(out, batch, options, stem);
  out << kRecord << "batch " << batch.number << ' ' << batch.job_name << '\n';
  for (const Job& job : batch.jobs) {
    out << kRecord << "job " << job.id << ' ' << job.attempt << ' ' << job.folder.string() << '\n';
  }
  AddJobs(out, batch);
  out << "cd \"$folder\" || exit 1\n";
  AddEnd(out, batch);
  // A set-up that fails is none of the trial.
  out << "trap 'exit 143' TERM\n"
      << "trap 'left=$?; [ $left -gt 128 ] && [ $left -lt 193 ] || write_end $left 0 0 " << kInSetUp
      << "' EXIT\n";
  if (!options.modules.empty()) {
    out << "module load";
    for (const std::string& module : options.modules) out << ' ' << base::ShellQuoted(module);
    out << " || exit 1\n";
  }
  for (const std::string& line : options.setup) out << line << '\n';
  // The set-up may have gone elsewhere, or have asked that a failing command ends the script.
  out << "set +eu\n"
      << "cd \"$folder\" || exit 1\n";
  // A step does not inherit what sbatch was asked for.
  out << "export OMP_NUM_THREADS=" << options.cores << " OMP_WAIT_POLICY=passive"
      << " SRUN_CPUS_PER_TASK=" << options.cores << "\n";
  for (const auto& [name, value] : kSharingRanks) out << "export " << name << '=' << value << '\n';
  out << "trap - EXIT TERM\n"
      << "started=$(now)\n"
      << "\"${command[@]}\" >" << rigs::kLogFile << " 2>&1 </dev/null\n"
      << "status=$?\n"
      << "took=$(($(now) - started))\n";
  // /proc/PID/stat, fields 16 and 17: processor time of the children that have ended, in ticks.
  out << "stat=$(</proc/$$/stat)\n"
      << "fields=(${stat##*) })\n"
      << "cpu=$(((fields[13] + fields[14]) * 1000 / $(getconf CLK_TCK)))\n"
      << "write_end $status $took $cpu " << kOfCommand << "\n"
      << "log=" << base::ShellQuoted(TaskLog(stem, "").string()) << "\n"
      << "log=${log%.log}$task.log\n"
      << "[ -s \"$log\" ] || rm -f \"$log\"\n"
      << "exit $status\n";
  return out.str();
}

std::filesystem::path TaskLog(const std::filesystem::path& stem, const std::string& task) {
  return stem.string() + "-" + task + ".log";
}

std::optional<Batch> ParseBatch(const std::string& script) {
  Batch batch;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kRecord)) continue;
    std::istringstream words(line.substr(std::string(kRecord).size()));
    std::string kind;
    words >> kind;
    if (kind == "batch") words >> batch.number >> batch.job_name;
    if (kind == "job") {
      Job job;
      std::string folder;
      words >> job.id >> job.attempt >> std::ws;
      std::getline(words, folder);
      job.folder = folder;
      batch.jobs.push_back(std::move(job));
    }
  }
  if (batch.number <= 0 || batch.job_name.empty() || batch.jobs.empty()) return std::nullopt;
  return batch;
}

std::optional<TaskEnd> ReadTaskEnd(const std::filesystem::path& folder) {
  std::ifstream in(folder / rigs::kTaskEndFile);
  TaskEnd end;
  std::string last;
  if (!(in >> end.batch >> end.task >> end.status >> end.duration >> end.cpu_time >> end.restarts >>
        end.host >> last) ||
      (last != kOfCommand && last != kInSetUp)) {
    return std::nullopt;
  }
  end.in_set_up = last == kInSetUp;
  end.duration *= 1e-6;
  end.cpu_time *= 1e-3;
  return end;
}

}  // namespace talus::runners
