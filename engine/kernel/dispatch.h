// The widest kernels that this machine can run.
#pragma once

#include <string_view>
#include <vector>

#include "engine/kernel/kernel.h"

namespace talus::engine {

// All that run here, widest first.
std::vector<const KernelTable*> AvailableKernels();

// The widest, or the one that the environment variable TALUS_SIMD (avx512, avx2, sse2) names.
// Throws ConfigError when that one does not exist or cannot run here.
const KernelTable& ChooseKernels();

}  // namespace talus::engine
