// What two tests share of the misfit.
#include "optimizer/posterior/joint_misfit.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/random.h"
#include "optimizer/posterior/residual_correlation.h"

namespace talus::optimizer {
namespace joint_misfit_test {

Eigen::MatrixXd Normals(int rows, int columns, std::uint64_t seed) {
  base::Random random(seed, base::Stream("residuals"));
  Eigen::MatrixXd z(rows, columns);
  for (double& value : z.reshaped()) value = random.Normal();
  return z;
}

// One output each, whose leave-one-out residuals correlate by 0.8.
Eigen::MatrixXd Correlated() {
  Eigen::MatrixXd z = Normals(400, 2, 5);
  z.col(1) = 0.8 * z.col(0) + 0.6 * z.col(1);
  return z;
}

TEST(JointMisfit, TestsWithAPerfectSurrogateAreIndependent) {
  const JointMisfit misfit(Correlated(), {0, 1});
  const Eigen::RowVector2d residual(0.5, -0.7);
  const Eigen::RowVector2d none(0, 0);
  EXPECT_NEAR(misfit.Squared(residual, none)[0], residual.squaredNorm(), 1e-12);
}

TEST(JointMisfit, WhatIsTheSurrogatesAloneIsSharedAsTheResidualsAre) {
  const Eigen::MatrixXd z = Correlated();
  const JointMisfit misfit(z, {0, 1});
  const Eigen::RowVector2d residual(0.5, -0.7);
  const double r = ResidualCorrelation(z, {0, 1})(0, 1);
  const auto closed = [&](double shared) {  // rᵀ R⁻¹ r of two outputs
    return (residual.squaredNorm() - 2 * shared * residual[0] * residual[1]) /
           (1 - shared * shared);
  };
  EXPECT_NEAR(misfit.Squared(residual, Eigen::RowVector2d(1, 1))[0], closed(r), 1e-9);
  EXPECT_NEAR(misfit.Squared(residual, Eigen::RowVector2d(0.25, 0.64))[0], closed(0.4 * r), 1e-9);
}

// Most sets of a campaign have been simulated for one of its tests only. Filled with zeros, which
// the other residual would have to be, their misfits were 2.8 times as large.
TEST(JointMisfit, SetsOfOneTestAskForNoTemper) {
  Eigen::MatrixXd z = Correlated();
  for (Eigen::Index i = 0; i < z.rows(); i += 2) z(i, i / 2 % 2) = std::nan("");
  const JointMisfit misfit(z, {0, 1});
  // Heavy tails ask for more than a normal residual has: nominal regions hold 94 to 97 %.
  EXPECT_EQ(misfit.temper(), 1);
  EXPECT_NEAR(misfit.coverage().raw, 0.95, 0.03);
}

TEST(JointMisfit, WithinATestTheSharesChangeNothing) {
  Eigen::MatrixXd z = Correlated();
  const JointMisfit alone(z, {0, 0});
  Eigen::MatrixXd beside(z.rows(), 3);
  beside << z, Normals(400, 1, 6);
  const JointMisfit both(beside, {0, 0, 1});
  const double expected = alone.Squared(Eigen::RowVector2d(0.5, -0.7), Eigen::RowVectorXd(1))[0];
  const double with_other =
      both.Squared(Eigen::RowVector3d(0.5, -0.7, 0), Eigen::RowVector2d(0, 0))[0];
  EXPECT_NEAR(with_other, expected, 0.03);  // 400 rows shrink the two a little differently
}

// A campaign of two tests with eight outputs each, twelve evaluations of which they share, and one
// odd evaluation among them, as coarse grains make it: a set that misses every output by half a
// standard deviation must not come out as impossible, whatever the signs.
TEST(JointMisfit, ADozenSharedEvaluationsMakeNoSmallResidualImpossible) {
  std::vector<int> test(16, 0);
  std::fill(test.begin() + 8, test.end(), 1);
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Eigen::MatrixXd z = Normals(12, 16, seed);
    z.row(0) *= 3;
    const JointMisfit misfit(z, test);
    const Eigen::MatrixXd correlation = ResidualCorrelation(z, test);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation);
    // The direction that the twelve make least likely, as long as sixteen halves.
    const Eigen::RowVectorXd residual = 2 * eigen.eigenvectors().col(0).transpose();
    const double m = misfit.Squared(residual, Eigen::RowVector2d(0.25, 0.25))[0];
    worst = std::max(worst, m / residual.squaredNorm());
  }
  // All of C would give 1 / 0.05 = 20 times |r|² at its floor.
  EXPECT_LT(worst, 4);
}

// Leave-one-out residuals twice as large as the surrogate says: the misfit is divided until nine
// tenths of them lie in the regions of 90 %.
TEST(JointMisfit, ResidualsBeyondTheirErrorsAreTempered) {
  const JointMisfit misfit(2 * Normals(400, 2, 5), {0, 1});
  EXPECT_GT(misfit.temper(), 2);
  EXPECT_LT(misfit.coverage().raw, 0.75);
  EXPECT_NEAR(misfit.coverage().tempered, 0.9, 0.01);
}

}  // namespace joint_misfit_test
}  // namespace talus::optimizer
