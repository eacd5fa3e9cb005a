// Standard normal draws for expectations that stay the same from point to point.
#pragma once

#include <Eigen/Core>

#include "base/random.h"

namespace talus::optimizer {

// One draw a row, `num_draws` of them, an even number: the second half are the mirror images of the
// first, so that all odd moments are zero. The first rows do not depend on how many there are.
inline Eigen::MatrixXd MirroredNormals(Eigen::Index num_draws, Eigen::Index num_columns,
                                       base::Random random) {
  Eigen::MatrixXd normals(num_draws, num_columns);
  const Eigen::Index half = num_draws / 2;
  for (Eigen::Index i = 0; i < half; ++i) {
    for (double& z : normals.row(i)) z = random.Normal();
  }
  normals.bottomRows(half) = -normals.topRows(half);
  return normals;
}

}  // namespace talus::optimizer
