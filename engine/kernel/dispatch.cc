#include "engine/kernel/dispatch.h"

#include <cstdlib>
#include <string>

#include "base/error.h"

namespace talus::engine {

std::vector<const KernelTable*> AvailableKernels() {
  std::vector<const KernelTable*> list;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
    list.push_back(&avx512::kTable);
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    list.push_back(&avx2::kTable);
  }
  list.push_back(&sse2::kTable);
  return list;
}

const KernelTable& ChooseKernels() {
  const auto list = AvailableKernels();
  const char* wanted = std::getenv("TALUS_SIMD");
  if (wanted == nullptr || *wanted == '\0') return *list.front();
  std::string names;
  for (const KernelTable* table : list) {
    if (std::string_view(wanted) == table->name) return *table;
    names += (names.empty() ? "" : ", ") + std::string(table->name);
  }
  throw base::ConfigError("TALUS_SIMD is \"" + std::string(wanted) + "\"; this machine runs " +
                          names);
}

}  // namespace talus::engine
