// The vector type `Lanes` of the instruction set that this translation unit is compiled for.
//
// Everything that a kernel file defines lives in the namespace TALUS_TARGET, which the including
// file sets (avx512, avx2, sse2), so that no inline function compiled for a wide instruction set
// can replace its namesake in the common program.
//
// Each width has a file of its own because rows of the particles are loaded, transposed and added
// to differently at each: one text for all widths has to gather them, with the same bits at 0.55 of
// the speed (bench/RECORD.md).
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "engine/laws/number.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "engine/kernel/simd_avx512.h"
#elif defined(__AVX2__)
#include "engine/kernel/simd_avx2.h"
#else
#include "engine/kernel/simd_sse2.h"
#endif
