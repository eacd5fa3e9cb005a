// How many parameters the data move: the degrees of freedom of a fit.
//
//   Σ 1 over what is asked for + Σ (1 - s²/σ²) over the nuisances
//
// s the standard deviation of the posterior and σ that of the prior: a nuisance that its prior
// decides is hardly one.
#pragma once

#include <Eigen/Core>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

// `draws` of the posterior: equally likely, one a row.
double MovedParameters(const Domain& domain, const Eigen::MatrixXd& draws);

}  // namespace talus::optimizer
