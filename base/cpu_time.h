// Processor time of a process, as POSIX counts it.
#pragma once

#include <sys/resource.h>

namespace talus::base {

// User and system time together [s].
inline double CpuTime(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// What this process has taken so far [s].
inline double CpuTime() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return CpuTime(usage);
}

}  // namespace talus::base
