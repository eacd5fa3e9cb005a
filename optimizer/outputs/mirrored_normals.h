// Standard normal draws for expectations that stay the same from point to point.
#pragma once

#include <Eigen/Core>

#include "base/random.h"

namespace talus::optimizer {

// One draw a row, `num_draws` of them, an even number: the second half are the mirror images of the
// first, so that all odd moments are zero. The first rows do not depend on how many there are.
Eigen::MatrixXd MirroredNormals(Eigen::Index num_draws, Eigen::Index num_columns,
                                base::Random random);

// Along orthogonal directions, each of two lengths: second moments are exact, too, and the squared
// length has the mean and the variance of d normals, d and 2d. Draws of one length would hardly
// tell how a distance scatters that is least at zero. As many as fill whole bases, `num_draws` or
// more; mirrored.
Eigen::MatrixXd OrthogonalNormals(Eigen::Index num_draws, Eigen::Index num_columns,
                                  base::Random random);

}  // namespace talus::optimizer
