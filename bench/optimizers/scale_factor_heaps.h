// Synthetic heaps at several scale factors, as scale_factor_twins calibrates them, of any size.
//
// A heap at scale factor f costs f⁻⁴ core seconds, is that of parameters displaced by 0.08 (f - 1),
// and scatters more, as measured on heaps of three grain sizes (docs/validation.md).
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/optimizers/problems.h"
#include "optimizer/outputs/experiment_target.h"

namespace talus::bench {

inline constexpr int kHeaps = 5;  // the target is the mean of

inline double HeapCost(double factor) { return std::pow(factor, -4); }

// The level that Problem::MakeImage takes.
int NoiseLevel(double factor);

Image HeapAt(const Problem& problem, const Vec& x, double factor, std::uint64_t run);

// Each pixel repeated.
Image Enlarged(const Image& image, int width, int height);

// The mean of kHeaps images of finished heaps, and each of them.
optimizer::ExperimentTarget TargetOf(const std::vector<Image>& heaps);

}  // namespace talus::bench
