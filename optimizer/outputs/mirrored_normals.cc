#include "optimizer/outputs/mirrored_normals.h"

#include <Eigen/QR>
#include <cmath>
#include <vector>

namespace talus::optimizer {
namespace {

// Their squares have the mean d and the variance 2d; the smaller of one would be negative.
std::vector<double> LengthsOf(double d) {
  if (d < 2) return {0, 0, std::sqrt(3.0)};
  return {std::sqrt(d - std::sqrt(2 * d)), std::sqrt(d + std::sqrt(2 * d))};
}

// One direction a row.
Eigen::MatrixXd RandomBasis(Eigen::Index size, base::Random& random) {
  const Eigen::MatrixXd normals =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return random.Normal(); });
  return Eigen::HouseholderQR<Eigen::MatrixXd>(normals).householderQ();
}

}  // namespace

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
  if (num_columns == 0) return Eigen::MatrixXd(num_draws, 0);  // images that are all alike
  const std::vector<double> lengths = LengthsOf(static_cast<double>(num_columns));
  const Eigen::Index of_basis = num_columns * static_cast<Eigen::Index>(lengths.size());
  const Eigen::Index num_bases = (num_draws / 2 + of_basis - 1) / of_basis;
  Eigen::MatrixXd normals(2 * num_bases * of_basis, num_columns);
  Eigen::Index row = 0;
  for (Eigen::Index basis = 0; basis < num_bases; ++basis) {
    const Eigen::MatrixXd directions = RandomBasis(num_columns, random);
    for (const double length : lengths) {
      normals.middleRows(row, num_columns) = length * directions;
      row += num_columns;
    }
  }
  normals.bottomRows(row) = -normals.topRows(row);
  return normals;
}

}  // namespace talus::optimizer
