// Processor time and time passed, for the benchmarks that print both.
//
// The calling thread's share tells on a busy machine how soon its loops could end with idle cores:
// of two threads, total / max(own, total - own) times as soon as on one.
#pragma once

#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>

namespace talus::bench {

// "processor time of all threads/of this one/time passed [s]" since it was made.
class Stopwatch {
 public:
  std::string Read() const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall_;
    char text[64];
    std::snprintf(text, sizeof text, "%.2f/%.2f/%.2f",
                  static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC,
                  ThreadSeconds() - thread_, passed.count());
    return text;
  }

 private:
  static double ThreadSeconds() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::clock_t processor_ = std::clock();
  double thread_ = ThreadSeconds();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

}  // namespace talus::bench
