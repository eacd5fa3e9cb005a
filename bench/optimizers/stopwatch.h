// Processor time and time passed, for the benchmarks that print both.
#pragma once

#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>

namespace talus::bench {

// "processor time/time passed [s]" since it was made.
class Stopwatch {
 public:
  std::string Read() const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall_;
    char text[64];
    std::snprintf(text, sizeof text, "%.2f/%.2f",
                  static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC, passed.count());
    return text;
  }

 private:
  std::clock_t processor_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

}  // namespace talus::bench
