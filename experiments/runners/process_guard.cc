#include "experiments/runners/process_guard.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <random>
#include <thread>

#include "base/error.h"
#include "base/files/descriptor.h"
#include "base/files/file.h"

namespace talus::runners {
namespace {

// Nothing of another user's process, or of one that is gone.
std::optional<std::string> EnvironmentOf(const std::string& pid) {
  const base::Descriptor file(::open(("/proc/" + pid + "/environ").c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return std::nullopt;
  std::string text;
  char bytes[8192];
  for (ssize_t count = 0; (count = ::read(file.get(), bytes, sizeof bytes)) > 0;) {
    text.append(bytes, static_cast<std::size_t>(count));
  }
  return text;
}

bool Holds(const std::optional<std::string>& environment, const std::string& mark) {
  return environment && environment->find(mark) != std::string::npos;
}

// While it becomes another program (execve) its environment is empty for a moment. Neither the
// kernel's threads nor what has ended have a program; a few programs have no environment for good.
bool HasProgram(const std::string& pid) {
  char first = 0;
  return ::readlink(("/proc/" + pid + "/exe").c_str(), &first, 1) > 0;
}

// The number may have gone to another process since we looked; a pidfd cannot.
bool Kill(const std::string& pid, const std::string& mark) {
  const base::Descriptor process(static_cast<int>(::syscall(SYS_pidfd_open, std::stoi(pid), 0)));
  return process.get() >= 0 && Holds(EnvironmentOf(pid), mark) &&
         ::syscall(SYS_pidfd_send_signal, process.get(), SIGKILL, nullptr, 0) == 0;
}

struct Round {
  int num_killed = 0;
  int num_unclear = 0;
};

Round KillRound(const std::string& mark) {
  DIR* const processes = ::opendir("/proc");
  if (processes == nullptr) return {};
  const std::string self = std::to_string(::getpid());
  Round round;
  while (const dirent* entry = ::readdir(processes)) {
    const std::string pid = entry->d_name;
    if (pid == self || pid.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::optional<std::string> environment = EnvironmentOf(pid);
    if (Holds(environment, mark)) {
      round.num_killed += Kill(pid, mark) ? 1 : 0;
    } else if (environment && environment->empty() && HasProgram(pid)) {
      ++round.num_unclear;
    }
  }
  ::closedir(processes);
  return round;
}

// The guard's side. Of its own session, so that what a terminal does to ours does not reach it. It
// keeps the campaign's lock, which we hold, until all has ended.
[[noreturn]] void Watch(int pipe, const std::string& token) {
  ::setsid();
  ::prctl(PR_SET_NAME, "talus-guard");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_IGN);
  const int null = ::open("/dev/null", O_RDWR);
  for (const int standard : {0, 1, 2}) ::dup2(null, standard);
  char byte = 0;
  while (::read(pipe, &byte, 1) < 0 && errno == EINTR) {
  }
  KillMarked(token);
  ::_exit(0);
}

// Only that no two running programs share it matters: no result depends on it.
std::string NewToken() {
  std::random_device chance;
  return base::Hex((static_cast<std::uint64_t>(chance()) << 32) ^ chance() ^
                   static_cast<std::uint64_t>(::getpid()));
}

}  // namespace

ProcessGuard::ProcessGuard() : token_(NewToken()) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw base::Error(std::string("no pipe can be made: ") + std::strerror(errno));
  }
  guard_ = ::fork();
  if (guard_ == 0) {
    ::close(ends[1]);
    Watch(ends[0], token_);
  }
  const int code = errno;
  ::close(ends[0]);
  pipe_ = ends[1];
  if (guard_ >= 0) return;
  ::close(pipe_);
  throw base::Error(std::string("no process can be started: ") + std::strerror(code));
}

ProcessGuard::~ProcessGuard() {
  ::close(pipe_);
  while (::waitpid(guard_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::string ProcessGuard::MarkOf(std::int64_t job) const {
  return token_ + "/" + std::to_string(job) + ";";
}

std::string MarkEntry(const std::string& mark) {
  const char* outer = std::getenv(kMarkVariable);
  return std::string(kMarkVariable) + "=" + (outer == nullptr ? "" : outer) + mark;
}

void KillMarked(const std::string& mark) {
  constexpr auto kPause = std::chrono::milliseconds(2);
  constexpr int kMostUnclear = 50;  // rounds in turn
  int unclear = 0;
  for (int i = 0; i < 5000; ++i) {
    const Round round = KillRound(mark);
    unclear = round.num_killed > 0 ? 0 : unclear + 1;
    if (round.num_killed == 0 && (round.num_unclear == 0 || unclear > kMostUnclear)) return;
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace talus::runners
