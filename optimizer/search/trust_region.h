// A quadratic model of the values round the best point, minimised within a trust region
// [powell2009].
//
// The region needs no memory: its radius is the distance to the neighbours the model stands on. As
// steps land near the best point the neighbours come closer and the region shrinks; when a step to
// its edge is an improvement the best point moves away from them and it stays wide.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimizer/search/history.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// No point when there are too few evaluations, or when the model is lowest where the best point is.
std::optional<Eigen::VectorXd> TrustRegionStep(const History& history, const Domain& domain);

}  // namespace talus::optimizer
