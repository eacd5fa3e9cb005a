#include "experiments/runners/local_runner.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "base/cpu_time.h"
#include "base/error.h"
#include "base/files/descriptor.h"
#include "base/files/file.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/runners/exit_status.h"

namespace talus::runners {
namespace {

constexpr auto kLogInterval = std::chrono::seconds(1);  // between two looks at the logs' sizes
constexpr double kLongest = 1e9;  // of any job [s]: a clock counts nanoseconds

std::string HostName() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

// What /proc/PID/stat says of a process: nothing when it is gone.
struct ProcessState {
  char state = 0;  // 'Z' once it has ended and waits for its parent to notice
  pid_t group = 0;
  std::string start;  // tells it from a later process that was given the same number
};

ProcessState StateOf(const std::string& pid) {
  std::ifstream in("/proc/" + pid + "/stat");
  std::string line;
  std::getline(in, line);
  const auto end_of_name = line.rfind(')');
  if (end_of_name == std::string::npos) return {};
  ProcessState process;
  std::istringstream fields(line.substr(end_of_name + 1));
  std::string skipped;
  fields >> process.state >> skipped >> process.group;
  constexpr int kFieldsBeforeStart = 16;  // 6 … 21
  for (int i = 0; i < kFieldsBeforeStart; ++i) fields >> skipped;
  fields >> process.start;
  return process;
}

bool GroupRuns(pid_t group) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const ProcessState process = StateOf(name);
    if (process.group == group && process.state != 'Z') return true;
  }
  return false;
}

// Ends the process group `group`, if it is still the one whose leader started at `start`.
void EndGroup(pid_t group, const std::string& start) {
  const ProcessState leader = StateOf(std::to_string(group));
  // The leader may be gone while its children live; a group's number is not used again until they
  // are gone too.
  if (leader.state != 0 && leader.start != start) return;
  if (::kill(-group, SIGKILL) != 0) return;
  constexpr auto kPause = std::chrono::milliseconds(2);
  constexpr auto kMostPatience = std::chrono::minutes(2);
  for (auto waited = std::chrono::nanoseconds(0); GroupRuns(group); waited += kPause) {
    if (waited > kMostPatience) {
      throw base::Error("the processes of an earlier attempt (group " + std::to_string(group) +
                        ") do not end, as where a disk does not answer; end them and resume");
    }
    std::this_thread::sleep_for(kPause);
  }
}

// What an earlier, killed program has left running in this folder.
void EndLeftOver(const std::filesystem::path& folder) {
  std::ifstream in(folder / rigs::kGroupFile);
  pid_t group = 0;
  std::string start;
  std::string mark;
  if (!(in >> group >> start) || group <= 1) return;
  EndGroup(group, start);
  constexpr std::size_t kShortest = 18;  // 16 digits, "/" and ";": a torn mark would fit too many
  if (in >> mark && mark.size() > kShortest && mark.back() == ';') KillMarked(mark);
}

// What EndLeftOver reads, where the guard was killed too. The command waits for it: one of which
// nothing is written could not be found, and one that takes its folder away would be too fast for
// it.
void WriteGroup(const std::filesystem::path& folder, pid_t pid, const std::string& mark) {
  const std::string start = StateOf(std::to_string(pid)).start;
  base::WriteFileAtomically(folder / rigs::kGroupFile,
                            std::to_string(pid) + " " + start + " " + mark + "\n",
                            base::Outlives::kProgram);
}

// Holds a forked process back until it may begin.
class Gate {
 public:
  Gate() : event_(::eventfd(0, EFD_CLOEXEC)) {
    if (event_.get() < 0) {
      throw base::Error(std::string("no process can be started: ") + std::strerror(errno));
    }
  }

  void Open() const { (void)::eventfd_write(event_.get(), 1); }
  bool Pass() const {  // in the child
    eventfd_t count = 0;
    return ::eventfd_read(event_.get(), &count) == 0;
  }

 private:
  base::Descriptor event_;
};

// The child's side: only what is allowed between fork and exec.
struct Launch {
  const char* folder;
  std::vector<char*> arguments;
  std::vector<char*> environment;
  int log;
  const Gate* gate;
  pid_t parent;
};

[[noreturn]] void BecomeCommand(const Launch& launch) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != launch.parent) ::_exit(kNoCommand);  // it went before prctl
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!launch.gate->Pass()) ::_exit(kNoCommand);
  const int null = ::open("/dev/null", O_RDONLY);
  if (null < 0 || ::dup2(null, 0) < 0 || ::dup2(launch.log, 1) < 0 || ::dup2(launch.log, 2) < 0 ||
      ::chdir(launch.folder) != 0) {
    ::_exit(kNoCommand);
  }
  ::execvpe(launch.arguments[0], launch.arguments.data(), launch.environment.data());
  constexpr char kMessage[] = "the command cannot be run: ";
  const char* reason = ::strerror(errno);
  (void)!::write(2, kMessage, sizeof kMessage - 1);
  (void)!::write(2, reason, ::strlen(reason));
  (void)!::write(2, "\n", 1);
  ::_exit(kNoCommand);
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Ours, with OpenMP, which foreign engines use, told to keep to its share and to sleep while it
// waits: a spinning thread would take the core of another trial.
std::vector<std::string> Environment(int threads, const std::string& mark) {
  std::vector<std::string> list;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (text.starts_with("OMP_NUM_THREADS=") || text.starts_with("OMP_WAIT_POLICY=") ||
        text.starts_with(std::string(kMarkVariable) + "=")) {
      continue;
    }
    list.emplace_back(text);
  }
  list.push_back("OMP_NUM_THREADS=" + std::to_string(threads));
  list.push_back("OMP_WAIT_POLICY=passive");
  for (const auto& [name, value] : kSharingRanks) {
    if (std::getenv(name) == nullptr) list.push_back(std::string(name) + "=" + value);
  }
  list.push_back(MarkEntry(mark));
  return list;
}

}  // namespace

LocalRunner::LocalRunner(const LocalRunnerOptions& options)
    : workers_(options.workers > 0
                   ? options.workers
                   : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      threads_per_job_(options.threads_per_job),
      largest_log_(options.largest_log),
      host_(HostName()) {}

LocalRunner::~LocalRunner() {
  for (auto& [id, process] : running_) {
    ::kill(-process.pid, SIGKILL);
    ::waitpid(process.pid, nullptr, 0);
    ::close(process.pid_file);
  }
}

std::vector<std::string> LocalRunner::Submit(std::span<const Job> jobs) {
  for (const Job& job : jobs) {
    try {
      StartProcess(job);
    } catch (const base::Error& error) {
      finished_.push_back({.id = job.id,
                           .end = JobEnd::kNotStarted,
                           .exit_status = 0,
                           .reason = error.what(),
                           .duration = 0,
                           .cpu_time = 0,
                           .host = host_});
    }
  }
  return std::vector<std::string>(jobs.size());
}

bool LocalRunner::Adopt(const Job& job, const std::string&) {
  EndLeftOver(job.folder);
  return false;
}

void LocalRunner::StartProcess(const Job& job) {
  EndLeftOver(job.folder);
  const Gate gate;
  const std::string log_name = (job.folder / rigs::kLogFile).string();
  const int log = ::open(log_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (log < 0) base::ThrowUnwritten(log_name, errno);

  std::vector<std::string> command = job.command;
  const std::string mark = guard_.MarkOf(job.id);
  std::vector<std::string> environment = Environment(threads_per_job_, mark);
  const Launch launch{.folder = job.folder.c_str(),
                      .arguments = Pointers(command),
                      .environment = Pointers(environment),
                      .log = log,
                      .gate = &gate,
                      .parent = ::getpid()};
  const pid_t pid = ::fork();
  if (pid == 0) BecomeCommand(launch);
  const int code = errno;
  ::close(log);
  if (pid < 0) throw base::Error(std::string("no process can be started: ") + std::strerror(code));
  ::setpgid(pid, pid);  // in parent and child, so that it holds before either goes on
  try {
    WriteGroup(job.folder, pid, mark);
  } catch (const base::Error&) {
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
    throw;
  }
  gate.Open();

  const auto now = Clock::now();
  const auto cap =
      std::chrono::duration<double>(job.time_cap > 0 ? std::min(job.time_cap, kLongest) : kLongest);
  running_[job.id] = {.pid = pid,
                      .pid_file = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)),
                      .start = now,
                      .deadline = now + std::chrono::duration_cast<Clock::duration>(cap),
                      .stopped = JobEnd::kExit,
                      .why = {},
                      .folder = job.folder};
}

std::vector<FinishedJob> LocalRunner::Wait(double seconds) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  CollectEnded();
  while (finished_.empty()) {
    const auto now = Clock::now();
    StopOverdue(now);
    auto until = std::min(end, now + kLogInterval);
    for (const auto& [id, process] : running_) {
      if (process.stopped == JobEnd::kExit) until = std::min(until, process.deadline);
    }
    if (now >= end) break;
    const bool interrupted = !WaitForOne(std::chrono::duration<double>(until - now).count());
    CollectEnded();
    if (interrupted) break;
  }
  return std::exchange(finished_, {});
}

// False when a signal ended the wait.
bool LocalRunner::WaitForOne(double seconds) const {
  std::vector<pollfd> ends;
  for (const auto& [id, process] : running_) ends.push_back({process.pid_file, POLLIN, 0});
  const int milliseconds = static_cast<int>(std::clamp(seconds * 1e3 + 1, 0.0, 1e6));
  return ::poll(ends.data(), ends.size(), milliseconds) >= 0 || errno != EINTR;
}

void LocalRunner::StopOverdue(Clock::time_point now) {
  for (auto& [id, process] : running_) {
    if (process.stopped != JobEnd::kExit) continue;
    std::error_code absent;
    const std::uintmax_t log = std::filesystem::file_size(process.folder / rigs::kLogFile, absent);
    if (now >= process.deadline) {
      Stop(process, JobEnd::kTimeCap, "was stopped at its time cap");
    } else if (!absent && log > largest_log_) {
      Stop(process, JobEnd::kSignal,
           "was stopped: it printed more than " + std::to_string(largest_log_ >> 20) +
               " MiB to its log.txt");
    }
  }
}

void LocalRunner::Stop(Process& process, JobEnd end, std::string why) {
  process.stopped = end;
  process.why = std::move(why);
  ::kill(-process.pid, SIGKILL);
}

void LocalRunner::CollectEnded() {
  for (auto it = running_.begin(); it != running_.end();) {
    siginfo_t info{};
    // Looks without reaping: its group can still be ended under its number.
    const bool ended = ::waitid(P_PID, static_cast<id_t>(it->second.pid), &info,
                                WEXITED | WNOHANG | WNOWAIT) == 0 &&
                       info.si_pid == it->second.pid;
    if (!ended) {
      ++it;
      continue;
    }
    finished_.push_back(Reap(it->first, it->second));
    KillMarked(guard_.MarkOf(it->first));  // what the command has left in other groups
    it = running_.erase(it);
  }
}

FinishedJob LocalRunner::Reap(std::int64_t id, Process& process) {
  ::kill(-process.pid, SIGKILL);  // whatever the command has left behind
  int status = 0;
  rusage usage{};
  ::wait4(process.pid, &status, 0, &usage);
  ::close(process.pid_file);
  std::error_code ignored;
  std::filesystem::remove(process.folder / rigs::kGroupFile, ignored);

  FinishedJob job{.id = id,
                  .end = process.stopped,
                  .exit_status = 0,
                  .reason = {},
                  .duration = std::chrono::duration<double>(Clock::now() - process.start).count(),
                  .cpu_time = base::CpuTime(usage),
                  .host = host_};
  if (process.stopped != JobEnd::kExit) {
    job.reason = process.why;
  } else if (WIFSIGNALED(status)) {
    job.end = IsFromOutside(WTERMSIG(status)) ? JobEnd::kPreempted : JobEnd::kSignal;
    job.reason = SignalText(WTERMSIG(status));
  } else {
    job.exit_status = WEXITSTATUS(status);
    job.reason = "exit status " + std::to_string(job.exit_status);
    if (job.exit_status == kNoCommand) job.end = JobEnd::kNotStarted;
  }
  return job;
}

void LocalRunner::Cancel(std::int64_t id) {
  const auto found = running_.find(id);
  if (found == running_.end()) return;
  Stop(found->second, JobEnd::kCancelled, "was cancelled");
}

}  // namespace talus::runners
