// A weighted sample of a density on the unit cube, by importance sampling from an even start, and
// from the prior where there is one, refined where the weights are [cappe2004]: it may be curved
// and have several branches.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "optimizer/posterior/posterior_sample.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct SampledSpace {
  const Domain* domain = nullptr;
  const Prior* prior = nullptr;  // part of the density
  int num_start = 0;             // even points of the cube
};

// Throws base::Error where the domain's constraints leave nothing.
PosteriorSample SampleByImportance(const LogDensityFunction& density, const SampledSpace& space,
                                   std::uint64_t seed);

}  // namespace talus::optimizer
