// The kernels for AVX-512; compiled with these instructions, and nothing else is.
#define TALUS_TARGET avx512
#include "engine/kernel/table.h"

namespace talus::engine::avx512 {

constinit const KernelTable kTable = MakeTable("avx512");

}  // namespace talus::engine::avx512
