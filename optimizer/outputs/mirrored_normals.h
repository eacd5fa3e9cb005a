// Standard normal draws for expectations that stay the same from point to point.
#pragma once

#include <Eigen/Core>

#include "base/random.h"

namespace talus::optimizer {

// One draw a row, `num_draws` of them, an even number: the second half are the mirror images of the
// first, so that all odd moments are zero. The first rows do not depend on how many there are.
Eigen::MatrixXd MirroredNormals(Eigen::Index num_draws, Eigen::Index num_columns,
                                base::Random random);

// The same with the first half along orthogonal directions, so that all second moments are exact,
// too: of `num_draws`, an even number, or twice as many as columns where these are more.
Eigen::MatrixXd OrthogonalNormals(Eigen::Index num_draws, Eigen::Index num_columns,
                                  base::Random random);

}  // namespace talus::optimizer
