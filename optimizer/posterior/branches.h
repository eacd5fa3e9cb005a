// The connected parts of a posterior's joint 90 % region.
#pragma once

#include <cstdint>
#include <vector>

#include "optimizer/posterior/asked_density.h"
#include "optimizer/posterior_summary.h"

namespace talus::optimizer {

// The branches of equally likely draws, in the parameters asked for: those inside the region are
// joined where the region does not break between them. The likeliest branch first; parts of less
// than 2 % of the draws are left out. PosteriorBranch::point is the draw of the branch's densest
// quarter that is nearest to all its others, and of the draws right beside that the densest: a
// small expected distance from the truth, and on the ridge, however bent that is. The nearest of
// all draws lies off it, on the inner side of the bend. Its nuisances are what is typical there.
std::vector<PosteriorBranch> FindBranches(const AskedDensity& posterior,
                                          const PosteriorSample& sample, std::uint64_t seed);

}  // namespace talus::optimizer
