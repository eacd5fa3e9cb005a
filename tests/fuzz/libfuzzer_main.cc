// One target as a libFuzzer program: TALUS_FUZZ_TARGET is its name, TALUS_FUZZ_LIST its list.
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/targets.h"

namespace {

// An input may take 0.1 s of processor time; the sanitizers take up to five times as long.
// libFuzzer's own cap is of wall time, which a busy machine takes for nothing.
constexpr double kMostSeconds = 0.5;

double ProcessorSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Slowest {
  double seconds = 0;
  ~Slowest() { std::fprintf(stderr, "slowest input: %.0f ms of processor time\n", 1e3 * seconds); }
} slowest;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const talus::fuzz::Target target = [] {
    for (const talus::fuzz::Target& each : talus::fuzz::TALUS_FUZZ_LIST()) {
      if (each.name == TALUS_FUZZ_TARGET) return each;
    }
    std::abort();
  }();
  const double start = ProcessorSeconds();
  target.run({reinterpret_cast<const char*>(data), size});
  const double seconds = ProcessorSeconds() - start;
  slowest.seconds = std::max(slowest.seconds, seconds);
  if (seconds > kMostSeconds) {
    std::fprintf(stderr, "this input takes %.0f ms of processor time\n", 1e3 * seconds);
    std::abort();
  }
  return 0;
}
