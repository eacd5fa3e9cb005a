#include "optimizer/posterior/residual_correlation.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace talus::optimizer {
namespace residual_correlation_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Normal residuals of six outputs, the first two of which correlate by `r`.
Eigen::MatrixXd Residuals(int rows, double r) {
  base::Random random(3, base::Stream("residuals"));
  Eigen::MatrixXd z(rows, 6);
  for (double& value : z.reshaped()) value = random.Normal();
  z.col(1) = r * z.col(0) + std::sqrt(1 - r * r) * z.col(1);
  return z;
}

double Least(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[0];
}

// Twelve rows of 36 pairs that have nothing to do with each other: raw, the least eigenvalue is
// 0.02, and a residual along it would count fifty times.
TEST(ResidualCorrelation, ChanceIsNotTakenForCorrelation) {
  const Eigen::MatrixXd correlation = ResidualCorrelation(Residuals(12, 0), {0, 0, 0, 1, 1, 1});
  EXPECT_GT(Least(correlation), 0.5);
}

// The sample's own r is within 0.03 of 0.8 for 400 rows (its sd is 0.018); shrinkage takes a
// little away.
TEST(ResidualCorrelation, WhatManyRowsShowStays) {
  const Eigen::MatrixXd correlation = ResidualCorrelation(Residuals(400, 0.8), {0, 0, 0, 1, 1, 1});
  EXPECT_NEAR(correlation(0, 1), 0.8, 0.06);
  EXPECT_NEAR(correlation(3, 4), 0, 0.12);
}

// Two numbers of one evaluation always correlate by ±1.
TEST(ResidualCorrelation, TestsThatShareFewRowsHaveTheSlightPriorOnly) {
  for (const int num_shared : {0, 1, 3}) {
    Eigen::MatrixXd z = Residuals(40 + num_shared, 0.8);
    z.topRightCorner(20, 3).setConstant(kNaN);
    z.bottomLeftCorner(20, 3).setConstant(kNaN);
    const Eigen::MatrixXd correlation = ResidualCorrelation(z, {0, 0, 0, 1, 1, 1});
    EXPECT_NEAR(correlation(0, 3), 0.5 / 6, 1e-12) << num_shared;
  }
}

TEST(ResidualCorrelation, IsPositiveDefiniteWhereOutputsAreTheSame) {
  Eigen::MatrixXd z = Residuals(200, 0);
  z.col(2) = z.col(0);
  z.col(5) = -z.col(3);
  const Eigen::MatrixXd correlation = ResidualCorrelation(z, {0, 0, 0, 0, 0, 0});
  EXPECT_GE(Least(correlation), 0.049);
  EXPECT_EQ(correlation.diagonal(), Eigen::VectorXd::Ones(6));
}

}  // namespace residual_correlation_test
}  // namespace talus::optimizer
