#include "optimizer/outputs/mirrored_normals.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

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

Eigen::MatrixXd OrthogonalNormals(Eigen::Index num_draws, Eigen::Index num_columns,
                                  base::Random random) {
  const Eigen::Index half = std::max(num_draws / 2, num_columns);
  Eigen::MatrixXd normals = MirroredNormals(2 * half, num_columns, random);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(normals.topRows(half));
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(half, num_columns);
  normals.topRows(half) = std::sqrt(static_cast<double>(half)) * q;
  normals.bottomRows(half) = -normals.topRows(half);
  return normals;
}

}  // namespace talus::optimizer
