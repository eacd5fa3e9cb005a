#include "optimizer/outputs/mirrored_normals.h"

namespace talus::optimizer {

Eigen::MatrixXd MirroredNormals(Eigen::Index num_draws, Eigen::Index num_columns,
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
