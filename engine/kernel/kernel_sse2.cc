// The kernels for the baseline of x86-64; compiled with these instructions, and nothing else is.
#define TALUS_TARGET sse2
#include "engine/kernel/table.h"

namespace talus::engine::sse2 {

constinit const KernelTable kTable = MakeTable("sse2");

}  // namespace talus::engine::sse2
