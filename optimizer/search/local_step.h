// The most promising point near the best one, by a Gaussian process of its neighbours alone.
//
// Along a curved valley, or where an objective spans decades, no process of all evaluations
// predicts the small differences round the best point; one of the nearest 10 d, with its own scale,
// correlation lengths and kernel, does. The region is the box that reaches as far as the nearest
// 2 d neighbours: as steps land near the best point it shrinks, and it needs no memory.
//
// A misfit such as a sum of absolute differences has a cone at a minimum of zero, and its square a
// paraboloid: where all values are positive, the neighbours may be fitted squared.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "optimizer/search/history.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// For a deterministic objective. `pending` points are fantasised at their predicted mean. No
// point when there are too few evaluations.
std::optional<Eigen::VectorXd> LocalStep(const History& history, const Domain& domain,
                                         std::span<const Eigen::VectorXd> pending,
                                         std::uint64_t seed);

}  // namespace talus::optimizer
