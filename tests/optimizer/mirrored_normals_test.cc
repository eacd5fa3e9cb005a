#include "optimizer/outputs/mirrored_normals.h"

#include <gtest/gtest.h>

namespace talus::optimizer {
namespace mirrored_normals_test {

TEST(OrthogonalNormals, HaveTheMomentsOfNormals) {
  for (const Eigen::Index columns : {1, 3, 8, 12}) {
    const Eigen::MatrixXd z = OrthogonalNormals(16, columns, base::Random(1, 2));
    EXPECT_EQ(z.rows(), columns == 12 ? 24 : 16);
    EXPECT_LT(z.colwise().mean().cwiseAbs().maxCoeff(), 1e-14);
    const Eigen::MatrixXd second = z.transpose() * z / static_cast<double>(z.rows());
    EXPECT_LT((second - Eigen::MatrixXd::Identity(columns, columns)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(MirroredNormals, TheFirstDoNotDependOnHowManyThereAre) {
  const Eigen::MatrixXd few = MirroredNormals(4, 3, base::Random(1, 2));
  const Eigen::MatrixXd more = MirroredNormals(10, 3, base::Random(1, 2));
  EXPECT_EQ(few.topRows(2), more.topRows(2));
  EXPECT_EQ(few.bottomRows(2), -few.topRows(2));
}

}  // namespace mirrored_normals_test
}  // namespace talus::optimizer
