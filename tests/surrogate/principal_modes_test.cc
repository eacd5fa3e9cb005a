#include "surrogate/images/principal_modes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/surrogate/curves.h"

namespace talus::surrogate {
namespace principal_modes_test {

using test::Curve;
using test::kElements;

constexpr int kPoints = 25;

struct Data {
  Eigen::MatrixXd points{kPoints, 2};
  Eigen::MatrixXd vectors{kPoints, kElements};
};

Data MakeData(double noise) {
  base::Random random(5, base::Stream("mode process test"));
  Data data;
  for (Eigen::Index i = 0; i < kPoints; ++i) {
    data.points.row(i) << random.Uniform(), random.Uniform();
    data.vectors.row(i) = Curve(data.points.row(i));
    for (Eigen::Index k = 0; k < kElements; ++k) data.vectors(i, k) += noise * random.Normal();
  }
  return data;
}

TEST(PrincipalModes, AreOrthonormalAndLeaveOutOnlyTheWeakest) {
  const Data data = MakeData(0.01);
  const PrincipalModes modes = FitModes(data.vectors, Eigen::VectorXd::Ones(kPoints), 3);
  ASSERT_EQ(modes.basis.cols(), 3);
  EXPECT_LT((modes.basis.transpose() * modes.basis - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  // Three modes hold the curves; what is left is the noise in the other 27 of 30 directions.
  EXPECT_NEAR(modes.discarded.mean(), 1e-4 * 27 / 30, 2e-5);
}

TEST(PrincipalModes, AVectorOfWeightTwoCountsAsTwo) {
  const Data data = MakeData(0.1);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(kPoints);
  weights[3] = 2;
  Eigen::MatrixXd twice(kPoints + 1, kElements);
  twice << data.vectors, data.vectors.row(3);
  const PrincipalModes weighted = FitModes(data.vectors, weights, 3);
  const PrincipalModes copied = FitModes(twice, Eigen::VectorXd::Ones(kPoints + 1), 3);
  EXPECT_LT((weighted.mean - copied.mean).norm(), 1e-12);
  EXPECT_LT((weighted.basis - copied.basis).norm(), 1e-9);
}

// A third of the vectors have the noise sd 0.01, the others, with their weights, four times that.
TEST(PrincipalModes, WhatIsLeftOutIsOfAVectorOfWeightOne) {
  Data data = MakeData(0.01);
  const Data noisy = MakeData(0.04);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(kPoints);
  for (Eigen::Index i = 0; i < kPoints; ++i) {
    if (i % 3 == 0) continue;
    data.vectors.row(i) = noisy.vectors.row(i);
    weights[i] = 1.0 / 16;
  }
  EXPECT_NEAR(FitModes(data.vectors, weights, 3).discarded.mean(), 1e-4 * 27 / 30, 2e-5);
}

TEST(PrincipalModes, OfEqualVectorsAreNone) {
  const PrincipalModes modes =
      FitModes(Eigen::MatrixXd::Constant(5, 4, 2.5), Eigen::VectorXd::Ones(5), 3);
  EXPECT_EQ(modes.basis.cols(), 0);
  EXPECT_EQ(modes.mean, Eigen::VectorXd::Constant(4, 2.5));
}

}  // namespace principal_modes_test
}  // namespace talus::surrogate
