// A session of a campaign with drawn heaps in a process of its own, so that it can be killed.
#pragma once

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "tests/experiments/fake_heap.h"

namespace talus::campaign {

// Its exit status where the session ended by an exception; otherwise it is the CampaignEnd.
inline constexpr int kThrew = 77;

inline pid_t StartSession(const std::filesystem::path& folder, const FakeEngineOptions& engine = {},
                          rlim_t largest_file = RLIM_INFINITY) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  if (largest_file != RLIM_INFINITY) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{largest_file, largest_file};
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
