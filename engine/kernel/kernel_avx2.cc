// The kernels for AVX2 and FMA; compiled with these instructions, and nothing else is.
#define TALUS_TARGET avx2
#include "engine/kernel/table.h"

namespace talus::engine::avx2 {

constinit const KernelTable kTable = MakeTable("avx2");

}  // namespace talus::engine::avx2
