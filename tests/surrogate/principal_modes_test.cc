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

// Three modes hold the curves; what is left of a noise of 0.01 is that in the other 27 of 30
// directions, of which mean and modes have taken four of 25 shares: 21/25, times (25/21)².
constexpr double kLeftOfNoise = 1e-4 * 27 / 30 * 25 / 21;

TEST(PrincipalModes, AreOrthonormalAndLeaveOutOnlyTheWeakest) {
  const Data data = MakeData(0.01);
  const PrincipalModes modes = FitModes(data.vectors, Eigen::VectorXd::Ones(kPoints), 3);
  ASSERT_EQ(modes.basis.cols(), 3);
  EXPECT_LT((modes.basis.transpose() * modes.basis - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(modes.discarded.mean(), kLeftOfNoise, 2e-5);
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
  EXPECT_NEAR(FitModes(data.vectors, weights, 3).discarded.mean(), kLeftOfNoise, 2e-5);
}

// Rough vectors whose noise the modes take up: its amplitudes fall with the root of the wave
// number.
Eigen::MatrixXd RoughVectors(Eigen::Index count, base::Random& random) {
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(count, 60);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (int wave = 1; wave <= 24; ++wave) {
      const double sine = random.Normal() / std::sqrt(wave);
      const double cosine = random.Normal() / std::sqrt(wave);
      for (Eigen::Index x = 0; x < vectors.cols(); ++x) {
        const double angle = 2 * M_PI * wave * static_cast<double>(x) / 60;
        vectors(i, x) += sine * std::sin(angle) + cosine * std::cos(angle);
      }
    }
  }
  return vectors;
}

// Their own residuals were 0.4 of it.
TEST(PrincipalModes, WhatIsLeftOutIsThatOfAnotherVector) {
  base::Random random(11, base::Stream("rough vectors"));
  double stated = 0;
  double of_others = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const PrincipalModes modes = FitModes(RoughVectors(24, random), Eigen::VectorXd::Ones(24), 8);
    stated += modes.discarded.sum();
    const Eigen::MatrixXd others = RoughVectors(50, random).rowwise() - modes.mean.transpose();
    of_others += (others - others * modes.basis * modes.basis.transpose()).squaredNorm() / 50;
  }
  EXPECT_GT(stated, 0.8 * of_others);  // generalised cross-validation is known to some tenths
  EXPECT_LT(stated, 1.4 * of_others);
}

TEST(PrincipalModes, OfEqualVectorsAreNone) {
  const PrincipalModes modes =
      FitModes(Eigen::MatrixXd::Constant(5, 4, 2.5), Eigen::VectorXd::Ones(5), 3);
  EXPECT_EQ(modes.basis.cols(), 0);
  EXPECT_EQ(modes.mean, Eigen::VectorXd::Constant(4, 2.5));
}

}  // namespace principal_modes_test
}  // namespace talus::surrogate
