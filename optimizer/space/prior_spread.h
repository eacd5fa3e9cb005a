// How wide the prior of one coordinate is within the cube.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

// The prior's values of a coordinate inside the cube, ascending; the ends of the cube where it has
// hardly any there.
std::vector<double> PriorValues(const Domain& domain, Eigen::Index coordinate);

// Their standard deviation over that of the uniform density, at most 1.
double PriorSpread(const Domain& domain, Eigen::Index coordinate);
// The standard deviation itself, unit cube.
double PriorSd(const Domain& domain, Eigen::Index coordinate);

}  // namespace talus::optimizer
