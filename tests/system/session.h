// A session of a campaign with drawn heaps in a process of its own, so that it can be killed.
#pragma once

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "base/parallel_for.h"
#include "tests/experiments/fake_heap.h"

namespace talus::campaign {

// Its exit status where the session ended by an exception; otherwise it is the CampaignEnd.
inline constexpr int kThrew = 77;

// Ends this process by SIGKILL. The kernel keeps the time, so that the session never lives longer
// than it is given, however late a busy machine runs its parent.
inline void DieAfter(double seconds) {
  sigevent death{};
  death.sigev_notify = SIGEV_SIGNAL;
  death.sigev_signo = SIGKILL;
  timer_t timer{};
  const auto whole = static_cast<time_t>(seconds);
  const itimerspec once{.it_interval = {},
                        .it_value = {whole, static_cast<long>((seconds - whole) * 1e9)}};
  if (::timer_create(CLOCK_MONOTONIC, &death, &timer) != 0 ||
      ::timer_settime(timer, 0, &once, nullptr) != 0) {
    std::abort();
  }
}

struct SessionLimits {
  rlim_t largest_file = RLIM_INFINITY;  // [B]
  double lifetime = 0;                  // until its SIGKILL [s]; no end if 0
};

inline pid_t StartSession(const std::filesystem::path& folder, const FakeEngineOptions& engine = {},
                          const SessionLimits& limits = {}) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  // Threads do not survive a fork: the first parallel loop of the child would wait for them for
  // ever.
  base::SetMostLoopThreads(1);
  if (limits.lifetime > 0) DieAfter(limits.lifetime);
  if (limits.largest_file != RLIM_INFINITY) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{limits.largest_file, limits.largest_file};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  try {
    ::_exit(static_cast<int>(RunFake(folder, engine)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "a session ended by: %s\n", error.what());
    ::_exit(kThrew);
  }
}

inline int WaitForExit(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

inline void Pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace talus::campaign
