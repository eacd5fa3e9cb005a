// Designs within constraints: as many points as without them.
#pragma once

#include <cstdint>

#include "optimizer/designs/design.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// The first of Sobol's points that lie in the domain; fewer where a million hold no more.
Points SobolInside(const Domain& domain, int num_points, std::uint64_t seed);

// The index-th of them, from 0; they begin anew where there are fewer. Any point where there is
// none.
Eigen::VectorXd SobolPoint(const Domain& domain, int index, std::uint64_t seed);

// Those of `points` that lie in the domain, and Sobol's in place of the others.
Points PointsWithin(const Domain& domain, const Points& points, std::uint64_t seed);

}  // namespace talus::optimizer
