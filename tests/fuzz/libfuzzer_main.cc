// One target as a libFuzzer program: TALUS_FUZZ_TARGET is its name, TALUS_FUZZ_LIST its list.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const talus::fuzz::Target target = [] {
    for (const talus::fuzz::Target& each : talus::fuzz::TALUS_FUZZ_LIST()) {
      if (each.name == TALUS_FUZZ_TARGET) return each;
    }
    std::abort();
  }();
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
