// A wall clock that a test can set: in a program that includes this, the C library's functions that
// tell the time of day are ours, for the libraries too. Once only, by the file with main's tests.
#pragma once

#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

namespace talus {

// Added to the time of day [s]. With `alternating`, every other reading has it subtracted instead.
inline std::atomic<long> clock_jump{0};
inline std::atomic<bool> clock_alternates{false};
inline std::atomic<long> clock_readings{0};

inline long ClockJump() {
  const bool odd = ++clock_readings % 2 == 1;
  return clock_alternates && odd ? -clock_jump : clock_jump.load();
}

}  // namespace talus

extern "C" {

// NOLINTBEGIN: the names are the C library's
int clock_gettime(clockid_t clock, struct timespec* now) noexcept {
  const long failed = ::syscall(SYS_clock_gettime, clock, now);
  if (failed == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
    now->tv_sec += talus::ClockJump();
  }
  return static_cast<int>(failed);
}

int gettimeofday(struct timeval* now, void*) noexcept {
  struct timespec precise {};
  if (::clock_gettime(CLOCK_REALTIME, &precise) != 0) return -1;
  now->tv_sec = precise.tv_sec;
  now->tv_usec = precise.tv_nsec / 1000;
  return 0;
}

time_t time(time_t* seconds) noexcept {
  struct timespec precise {};
  ::clock_gettime(CLOCK_REALTIME, &precise);
  if (seconds != nullptr) *seconds = precise.tv_sec;
  return precise.tv_sec;
}
// NOLINTEND

}  // extern "C"
