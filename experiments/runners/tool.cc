#include "experiments/runners/tool.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "experiments/runners/exit_status.h"
#include "experiments/runners/process_guard.h"

namespace talus::runners {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) {
      throw base::Error(std::string("no pipe can be made: ") + std::strerror(errno));
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    ::close(ends[0]);
    CloseWriter();
  }
  void CloseWriter() {
    if (ends[1] >= 0) ::close(ends[1]);
    ends[1] = -1;
  }
  int ends[2] = {-1, -1};
};

// The end of what is printed on standard error says why; the rest is let go.
void KeepEnd(std::string& errors) {
  constexpr std::size_t kMost = 1 << 20;
  if (errors.size() > kMost) errors.erase(0, errors.size() - kMost / 2);
}

// A command that runs, and what it has printed so far.
class RunningTool {
 public:
  RunningTool(pid_t pid, std::array<Pipe, 2>& pipes, const ToolOptions& options)
      : pid_(pid),
        options_(options),
        open_{pollfd{pipes[0].ends[0], POLLIN, 0}, {pipes[1].ends[0], POLLIN, 0}} {}

  // Until the command itself has ended: what it has left in the background may keep the pipes open.
  ToolResult Finish(const std::string& name) {
    const auto cap = std::chrono::duration<double>(std::min(options_.time_cap, 1e9));
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(cap);
    std::string given_up;
    while (given_up.empty() && !HasEnded()) {
      Read(kPause);
      given_up = WhyGiveUp(end);
    }
    if (!given_up.empty()) {
      ::kill(-pid_, SIGKILL);
      while (!HasEnded()) Read(kPause);
    }
    while (Read(std::chrono::milliseconds(0))) {
    }
    if (given_up.empty()) given_up = WhyGiveUp(Clock::time_point::max());
    if (!given_up.empty()) result_.errors += name + " " + given_up;
    result_.status = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    if (!given_up.empty() && result_.status == 0) result_.status = 1;
    return std::move(result_);
  }

 private:
  static constexpr std::chrono::milliseconds kPause{5};

  bool HasEnded() {
    if (!has_ended_) has_ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return has_ended_;
  }

  // Whether anything was read, of what there is now or comes within the pause.
  bool Read(std::chrono::milliseconds pause) {
    std::string* texts[] = {&result_.output, &result_.errors};
    if (::poll(open_.data(), open_.size(), static_cast<int>(pause.count())) <= 0) return false;
    bool any = false;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i].fd < 0 || open_[i].revents == 0) continue;
      char bytes[65536];
      const ssize_t count = ::read(open_[i].fd, bytes, sizeof bytes);
      if (count > 0) texts[i]->append(bytes, static_cast<std::size_t>(count));
      any |= count > 0;
      if (count == 0 || (count < 0 && errno != EINTR)) open_[i].fd = -1;
    }
    KeepEnd(result_.errors);
    return any && result_.output.size() <= options_.most_output;
  }

  std::string WhyGiveUp(Clock::time_point end) const {
    if (result_.output.size() > options_.most_output) {
      return "printed more than " + std::to_string(options_.most_output >> 20) + " MiB";
    }
    if (Clock::now() >= end) return "gave no answer in time";
    return !has_ended_ && options_.is_stopped() ? "was stopped" : "";
  }

  pid_t pid_;
  const ToolOptions& options_;
  std::array<pollfd, 2> open_;
  ToolResult result_;
  int status_ = 0;
  bool has_ended_ = false;
};

// The pipe holds it all before anyone reads, so that nothing waits for a command that never does.
void Fill(Pipe& pipe, const std::string& input) {
  constexpr std::size_t kPipeHolds = 65536;
  const ssize_t written =
      input.size() > kPipeHolds ? -1 : ::write(pipe.ends[1], input.data(), input.size());
  if (written != static_cast<ssize_t>(input.size())) {
    throw base::Error("the input of a command does not fit into a pipe");
  }
  pipe.CloseWriter();
}

int Spawn(const std::vector<std::string>& command, const ToolOptions& options, const Pipe& input,
          const std::array<Pipe, 2>& pipes, pid_t& pid) {
  std::vector<std::string> arguments = command;
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input.ends[0], 0);
  if (options.output_file.empty()) {
    ::posix_spawn_file_actions_adddup2(&actions, pipes[0].ends[1], 1);
  } else {
    ::posix_spawn_file_actions_addopen(&actions, 1, options.output_file.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0666);
  }
  ::posix_spawn_file_actions_adddup2(&actions, pipes[1].ends[1], 2);
  // A group of its own: Ctrl-C at the terminal is for us, and must not stop it half-way.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<char*> environment;
  std::string mark = MarkEntry(options.mark);
  const std::string variable = std::string(kMarkVariable) + "=";
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string_view(*entry).starts_with(variable)) environment.push_back(*entry);
  }
  environment.push_back(mark.data());
  environment.push_back(nullptr);
  const int code =
      ::posix_spawnp(&pid, pointers[0], &actions, &attributes, pointers.data(), environment.data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return code;
}

}  // namespace

ToolResult RunTool(const std::vector<std::string>& command, const ToolOptions& options) {
  Pipe input;
  Fill(input, options.input);
  std::array<Pipe, 2> pipes;
  pid_t pid = -1;
  const int code = Spawn(command, options, input, pipes, pid);
  if (code == EAGAIN || code == ENOMEM) {
    throw base::Error(std::string("no process can be started: ") + std::strerror(code));
  }
  if (code != 0) {
    return {.status = kNoCommand,
            .output = {},
            .errors = command[0] + ": " + std::strerror(code),
            .started = false};
  }
  for (Pipe& pipe : pipes) pipe.CloseWriter();
  return RunningTool(pid, pipes, options).Finish(command[0]);
}

std::filesystem::path FindProgram(const std::string& program, const std::filesystem::path& folder) {
  const auto executable = [](const std::filesystem::path& path) {
    return ::access(path.c_str(), X_OK) == 0 && !std::filesystem::is_directory(path);
  };
  if (program.find('/') != std::string::npos) {
    const std::filesystem::path path = folder / program;  // an absolute program stays what it is
    return executable(path) ? path : std::filesystem::path();
  }
  const char* search = std::getenv("PATH");
  std::istringstream folders(search == nullptr ? "/usr/bin:/bin" : search);
  for (std::string place; std::getline(folders, place, ':');) {
    const std::filesystem::path path = std::filesystem::path(place) / program;
    if (!place.empty() && executable(path)) return path;
  }
  return {};
}

}  // namespace talus::runners
