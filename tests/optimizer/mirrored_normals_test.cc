#include "optimizer/outputs/mirrored_normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::optimizer {
namespace mirrored_normals_test {

TEST(OrthogonalNormals, HaveTheMomentsOfNormals) {
  for (const Eigen::Index columns : {1, 2, 3, 8, 12}) {
    const Eigen::MatrixXd z = OrthogonalNormals(16, columns, base::Random(1, 2));
    EXPECT_GE(z.rows(), 16);
    EXPECT_LT(z.colwise().mean().cwiseAbs().maxCoeff(), 1e-14);
    const Eigen::MatrixXd second = z.transpose() * z / static_cast<double>(z.rows());
    EXPECT_LT((second - Eigen::MatrixXd::Identity(columns, columns)).cwiseAbs().maxCoeff(), 1e-13);
    const auto d = static_cast<double>(columns);
    EXPECT_NEAR(z.rowwise().squaredNorm().array().square().mean(), d * (d + 2), 1e-11);
  }
  EXPECT_EQ(OrthogonalNormals(16, 8, base::Random(1, 2)).rows(), 32);
  EXPECT_EQ(OrthogonalNormals(16, 0, base::Random(1, 2)).rows(), 16);
}

// The distance from a target that is the mean: its sd is that of a χ distribution of 8 degrees, and
// was zero while all draws were of one length.
TEST(OrthogonalNormals, ADistanceScattersByThem) {
  const Eigen::VectorXd distances = OrthogonalNormals(16, 8, base::Random(1, 2)).rowwise().norm();
  const double sd = std::sqrt((distances.array() - distances.mean()).square().mean());
  EXPECT_NEAR(sd, 0.696, 0.05);  // √(8 - 2 (Γ(9/2)/Γ(4))²); two lengths are no distribution
}

TEST(MirroredNormals, TheFirstDoNotDependOnHowManyThereAre) {
  const Eigen::MatrixXd few = MirroredNormals(4, 3, base::Random(1, 2));
  const Eigen::MatrixXd more = MirroredNormals(10, 3, base::Random(1, 2));
  EXPECT_EQ(few.topRows(2), more.topRows(2));
  EXPECT_EQ(few.bottomRows(2), -few.topRows(2));
}

}  // namespace mirrored_normals_test
}  // namespace talus::optimizer
