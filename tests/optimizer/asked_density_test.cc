#include "optimizer/posterior/asked_density.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "optimizer/designs/r_sequence.h"
#include "optimizer/posterior/branches.h"
#include "optimizer/posterior/sample_statistics.h"

namespace talus::optimizer {
namespace asked_density_test {

// A normal density in the unit cube, far enough from its faces.
struct Normal {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;

  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points) const {
    const Eigen::MatrixXd root = covariance.llt().matrixL();
    const Eigen::MatrixXd white =
        root.triangularView<Eigen::Lower>().solve(points.transpose().colwise() - mean);
    return -0.5 * white.colwise().squaredNorm().transpose();
  }
};

// Two parameters asked for and two nuisances; the first nuisance hangs together with both.
Normal Correlated() {
  const Eigen::Vector4d sd(0.06, 0.05, 0.1, 0.08);
  Eigen::Matrix4d correlation = Eigen::Matrix4d::Identity();
  const auto set = [&](int i, int j, double r) { correlation(i, j) = correlation(j, i) = r; };
  set(0, 1, -0.6);
  set(0, 2, 0.8);
  set(1, 2, -0.3);
  return {.mean = Eigen::Vector4d(0.5, 0.45, 0.5, 0.55),
          .covariance = sd.asDiagonal() * correlation * sd.asDiagonal()};
}

PosteriorSample SampleOf(const LogDensityFunction& density, int dimension) {
  PosteriorSample sample;
  sample.points = RSequence(60000, dimension, 1);
  sample.log_density = density(sample.points);
  sample.volume = Eigen::VectorXd::Constant(sample.points.rows(), 1.0 / 60000);
  const double integral = LogSumExp(sample.log_density);
  sample.weight = (sample.log_density.array() - integral).exp();
  sample.SetRegion();
  return sample;
}

// The marginal of a normal density is the normal one of the block of its covariance, and 1 - exp(-
// r²/2) of a plane one lies within r standard deviations.
TEST(AskedDensity, IsTheMarginalOfANormalDensity) {
  const Normal normal = Correlated();
  const Domain domain{.num_parameters = 4, .nuisances = {2, 3}};
  const LogDensityFunction density = [&](const Eigen::MatrixXd& x) { return normal.LogDensity(x); };
  const PosteriorSample joint = SampleOf(density, 4);
  const AskedDensity asked(density, domain, joint, 1);
  const PosteriorSample sample = asked.Sample(joint);

  const Normal marginal{.mean = normal.mean.head(2),
                        .covariance = normal.covariance.topLeftCorner(2, 2)};
  const Eigen::Matrix2d root = marginal.covariance.llt().matrixL();
  const double at_mean = asked.LogDensity(normal.mean.transpose())[0];
  for (const double radius : {0.5, 1.0, 2.0, 2.5}) {
    for (const double angle : {0.3, 1.7, 3.0, 4.9}) {
      Eigen::VectorXd point = normal.mean;
      point.head(2) += root * radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      point.tail(2).setConstant(0.9);  // does not count
      const double log_density = asked.LogDensity(point.transpose())[0];
      // 48 nodes, spread by a thousand draws, leave 0.2; without the nuisances' correlation it
      // would be off by 2 and more.
      EXPECT_NEAR(log_density - at_mean, -0.5 * radius * radius, 0.2);
      EXPECT_NEAR(sample.CredibleLevel(log_density), 1 - std::exp(-0.5 * radius * radius), 0.04);
    }
  }
  // The ellipse that holds 0.9: π r² √det, r² = 2 ln 10.
  const double area =
      std::numbers::pi * 2 * std::log(10.0) * std::sqrt(marginal.covariance.determinant());
  EXPECT_NEAR(sample.RegionVolume(), area, 0.08 * area);
}

// A nuisance that follows a bend, narrowly: p(a) is even, but the nodes, spread about a straight
// line, find it at some values of a and miss it at others. The region is nine tenths of the range
// all the same.
TEST(AskedDensity, AVolumeDoesNotGrowByWhatTheNodesMiss) {
  const LogDensityFunction bend = [](const Eigen::MatrixXd& x) -> Eigen::VectorXd {
    const Eigen::ArrayXd middle = 0.1 + 0.8 * (2 * x.col(0).array() - 1).square();
    return -0.5 * ((x.col(1).array() - middle) / 0.01).square();
  };
  const Domain domain{.num_parameters = 2, .nuisances = {1}};
  const PosteriorSample joint = SampleOf(bend, 2);
  const PosteriorSample sample = AskedDensity(bend, domain, joint, 1).Sample(joint);
  // 500 points and a thousand draws tell it to 0.02; the sum of 1 / p(a) over the draws is above 1.
  EXPECT_NEAR(sample.RegionVolume(), 0.9, 0.06);
}

// A nuisance that follows a bend. Round one straight line for all of it the nodes met the density
// at some values of a and missed it at others, by up to three nats: a set on the edge of the region
// stood at .29.
TEST(AskedDensity, IsTheMarginalOfABentDensity) {
  static constexpr double kSd = 0.18, kAcross = 0.04;
  const LogDensityFunction bend = [](const Eigen::MatrixXd& x) -> Eigen::VectorXd {
    const Eigen::ArrayXd a = x.col(0).array();
    const Eigen::ArrayXd middle = 0.15 + 0.7 * (2 * a - 1).square();
    return -0.5 * ((a - 0.5) / kSd).square() -
           0.5 * ((x.col(1).array() - middle) / kAcross).square();
  };
  const Domain domain{.num_parameters = 2, .nuisances = {1}};
  const PosteriorSample joint = SampleOf(bend, 2);
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const AskedDensity asked(bend, domain, joint, seed);
    const PosteriorSample sample = asked.Sample(joint);
    const Eigen::ArrayXd off =
        sample.log_density.array() + 0.5 * ((sample.points.col(0).array() - 0.5) / kSd).square();
    EXPECT_LT(std::sqrt((off - off.mean()).square().mean()), 0.2) << seed;
    for (const double side : {-1, 1}) {
      const Eigen::RowVector2d edge(0.5 + side * 1.645 * kSd, 0);
      EXPECT_NEAR(sample.CredibleLevel(asked.LogDensity(edge)[0]), 0.9, 0.05) << seed;
    }
  }
}

// The mean of the nuisances given the others: m + S_na S_aa⁻¹ (a - its mean).
TEST(AskedDensity, TypicalNuisancesAreTheirMeanGivenTheOthers) {
  const Normal normal = Correlated();
  const Domain domain{.num_parameters = 4, .nuisances = {2, 3}};
  const LogDensityFunction density = [&](const Eigen::MatrixXd& x) { return normal.LogDensity(x); };
  const PosteriorSample joint = SampleOf(density, 4);
  const AskedDensity asked(density, domain, joint, 1);
  Eigen::VectorXd point = normal.mean;
  point[0] += 0.06;
  point[1] -= 0.03;
  const Eigen::VectorXd typical = asked.WithTypicalNuisances(point);
  const Eigen::Vector2d given =
      normal.mean.tail(2) + normal.covariance.bottomLeftCorner(2, 2) *
                                normal.covariance.topLeftCorner(2, 2).inverse() *
                                (point.head(2) - normal.mean.head(2));
  EXPECT_EQ(typical.head(2), point.head(2));
  EXPECT_NEAR(typical[2], given[0], 0.01);
  EXPECT_NEAR(typical[3], given[1], 0.01);
}

// Two answers that only a nuisance tells apart are one for who does not ask for it.
TEST(AskedDensity, BranchesAreOfWhatIsAskedFor) {
  const auto density_of = [](const Eigen::MatrixXd& x) -> Eigen::VectorXd {
    const auto bump = [&](double a, double n) {
      return (-0.5 *
              ((x.col(0).array() - a).square() / 0.01 + (x.col(1).array() - n).square() / 0.0016))
          .exp();
    };
    return (bump(0.5, 0.2) + bump(0.5, 0.8)).max(1e-300).log();
  };
  const PosteriorSample joint = SampleOf(density_of, 2);
  const Domain both{.num_parameters = 2};
  const AskedDensity of_both(density_of, both, joint, 1);
  EXPECT_EQ(FindBranches(of_both, of_both.Sample(joint), 1).size(), 2u);
  const Domain one{.num_parameters = 2, .nuisances = {1}};
  const AskedDensity of_one(density_of, one, joint, 1);
  const auto branches = FindBranches(of_one, of_one.Sample(joint), 1);
  ASSERT_EQ(branches.size(), 1u);
  EXPECT_NEAR(branches[0].point[0], 0.5, 0.05);
  // The nuisance is one of its two solutions, to two of its standard deviations, and not between.
  EXPECT_LT(std::min(std::abs(branches[0].point[1] - 0.2), std::abs(branches[0].point[1] - 0.8)),
            0.08);
}

// A valley bent round a corner of the cube, as that of two frictions with one measured angle. The
// middle of its draws lies beside the ridge, on the inner side: of those of the denser half by 0.5
// standard deviations in the mean of these seeds. One seed scatters by 0.3.
TEST(AskedDensity, ABentValleyIsAnsweredOnItsRidge) {
  constexpr double kRadius = 0.7;
  constexpr double kSd = 0.05;
  constexpr int kSeeds = 12;
  const auto valley = [&](const Eigen::MatrixXd& x) -> Eigen::VectorXd {
    return -0.5 * ((x.rowwise().norm().array() - kRadius) / kSd).square();
  };
  const PosteriorSample joint = SampleOf(valley, 2);
  const AskedDensity asked(valley, {.num_parameters = 2}, joint, 1);
  double beside = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto branches = FindBranches(asked, asked.Sample(joint), seed);
    ASSERT_EQ(branches.size(), 1u);
    beside += (branches[0].point.norm() - kRadius) / kSd / kSeeds;
  }
  EXPECT_NEAR(beside, 0, 0.25);
}

// With six parameters no draw of 300 has a neighbour within a third of the ranges.
TEST(AskedDensity, ABroadRegionOfManyParametersIsOneBranch) {
  const auto flat = [](const Eigen::MatrixXd& x) -> Eigen::VectorXd {
    return Eigen::VectorXd::Zero(x.rows());
  };
  const PosteriorSample joint = SampleOf(flat, 6);
  const AskedDensity asked(flat, {.num_parameters = 6}, joint, 1);
  EXPECT_EQ(FindBranches(asked, asked.Sample(joint), 1).size(), 1u);
}

TEST(AskedDensity, WithoutNuisancesIsTheDensityItself) {
  const Normal normal = Correlated();
  const Domain domain{.num_parameters = 4};
  const LogDensityFunction density = [&](const Eigen::MatrixXd& x) { return normal.LogDensity(x); };
  const PosteriorSample joint = SampleOf(density, 4);
  const AskedDensity asked(density, domain, joint, 1);
  EXPECT_EQ(asked.LogDensity(joint.points.topRows(50)), joint.log_density.head(50));
  EXPECT_EQ(asked.WithTypicalNuisances(normal.mean), normal.mean);
  EXPECT_EQ(asked.Sample(joint).weight, joint.weight);
}

// 1 - √(1 - ρ²) of a normal pair.
TEST(Narrowing, IsWhatARegressionExplains) {
  base::Random random(1, base::Stream("test"));
  Eigen::MatrixXd draws(4000, 3);
  for (auto row : draws.rowwise()) {
    row[0] = random.Normal();
    row[1] = 0.6 * row[0] + 0.8 * random.Normal();
    row[2] = row[0] * row[0];
  }
  EXPECT_NEAR(Narrowing(draws, 0, 1), 0.2, 0.03);
  EXPECT_NEAR(Narrowing(draws, 1, 0), 0.2, 0.03);
  EXPECT_NEAR(Narrowing(draws, 0, 2), 1, 1e-6);  // a bent valley ties as a straight one does
}

}  // namespace asked_density_test
}  // namespace talus::optimizer
