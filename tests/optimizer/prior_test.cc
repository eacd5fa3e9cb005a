#include "optimizer/space/prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "optimizer/designs/posterior_design.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/draws_density.h"
#include "optimizer/space/parameter_space.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace prior_test {

// The integral of the density over [0, 1], by the midpoint rule.
double Mass(const Prior& prior) {
  constexpr int kCells = 20000;
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(kCells, 0.5 / kCells, 1 - 0.5 / kCells);
  return prior.LogDensity(u).array().exp().mean();
}

// A density of the value must not change with the scale that the value is searched on: the missing
// slope of the map, or of the logarithm, would.
TEST(Prior, IsADensityOfTheValueOnEitherScale) {
  for (const Scale scale : {Scale::kLinear, Scale::kLog}) {
    for (const bool of_logarithm : {false, true}) {
      const ScaledRange range{.low = 0.05, .high = 2, .scale = scale};
      const NormalPrior normal = of_logarithm ? NormalPrior{std::log(0.4), std::log(1.3), true}
                                              : NormalPrior{0.4, 0.06, false};
      Prior prior;
      prior.Add(0, range, normal);
      // The range leaves out less than 1e-5 of each.
      EXPECT_NEAR(Mass(prior), 1, 1e-4);
      Prior half;  // the median as upper end of the range
      half.Add(0, {.low = 0.05, .high = 0.4, .scale = scale}, normal);
      EXPECT_NEAR(Mass(half), 0.5, 1e-4);
    }
  }
}

TEST(Prior, DrawsHaveItsMeanAndSpread) {
  Prior prior;
  const ScaledRange range{.low = 1e-6, .high = 1e-3, .scale = Scale::kLog};
  prior.Add(1, range, {std::log(2e-5), std::log(2.0), true});
  const Eigen::MatrixXd draws = prior.Draw(4000, 2, 1);
  const Eigen::ArrayXd logs =
      draws.col(1).unaryExpr([&](double u) { return std::log(range.ToNative(u)); });
  EXPECT_NEAR(logs.mean(), std::log(2e-5), 0.04);  // 4 standard errors
  EXPECT_NEAR(std::sqrt((logs - logs.mean()).square().mean()), std::log(2.0), 0.03);
  EXPECT_NEAR(draws.col(0).mean(), 0.5, 0.02);  // nothing is said of it
  const Eigen::VectorXd offset = prior.Offset(draws);
  EXPECT_TRUE(std::isnan(offset[0]));
  EXPECT_NEAR(offset[1], 0, 0.06);
  // Every value twice as large is one standard deviation off, but for the 1e-5 that the range
  // leaves out: 4.3 standard deviations and more below the median, where they have 1e-4 of the
  // variance.
  Eigen::MatrixXd twice = draws;
  twice.col(1).array() += std::log(2.0) / std::log(1e3);
  EXPECT_NEAR(prior.Offset(twice)[1] - offset[1], 1, 1e-4);
}

// What is in force is the prior inside the range: nothing has moved draws of it.
TEST(Prior, OffsetsAreFromThePriorThatTheRangeCuts) {
  Prior prior;
  const ScaledRange range{.low = 0.1, .high = 0.9};
  prior.Add(0, range, {.mean = 0.1, .sd = 0.1, .of_logarithm = false});
  Eigen::MatrixXd draws = prior.Draw(20000, 1, 1);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (draws(i, 0) >= 0 && draws(i, 0) <= 1) inside.push_back(i);
  }
  // Half of a normal: mean √(2/π), variance 1 - 2/π. Four standard errors of 10 000 draws.
  EXPECT_NEAR(prior.Offset(draws(inside, Eigen::all))[0], 0, 0.04);
  const Eigen::MatrixXd at_its_end = Eigen::MatrixXd::Zero(10, 1);
  EXPECT_NEAR(prior.Offset(at_its_end)[0],
              -std::sqrt(2 / std::numbers::pi / (1 - 2 / std::numbers::pi)), 1e-9);
}

// Draws of a thin arc: one Gaussian for all would give its middle, which is empty, as much density
// as its ends, and kernels as wide as the arc would make it three times as thick.
TEST(DrawsDensity, FollowsABentValley) {
  constexpr int kDraws = 1000;
  constexpr double kThick = 0.01;  // sd
  base::Random random(3, base::Stream("arc"));
  Eigen::MatrixXd draws(kDraws, 2);
  const auto at = [](double angle, double radius) {
    return Eigen::RowVector2d(0.1 + radius * std::cos(angle), 0.1 + radius * std::sin(angle));
  };
  for (int i = 0; i < kDraws; ++i) {
    draws.row(i) = at(1.57 * random.Uniform(), 0.7 + kThick * random.Normal());
  }
  const DrawsDensity density(draws);
  const Eigen::MatrixXd square = RSequence(40000, 2, 1);
  const Eigen::ArrayXd p = density.LogDensity(square).array().exp();
  EXPECT_NEAR(p.mean(), 1, 0.03);  // some of the broad Gaussian lies outside
  double across = 0;
  double inside = 0;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const double off = std::hypot(square(i, 0) - 0.1, square(i, 1) - 0.1) - 0.7;
    if (std::abs(off) > 0.05) continue;
    across += p[i] * off * off;
    inside += p[i];
  }
  EXPECT_NEAR(std::sqrt(across / inside), kThick, 0.35 * kThick);
  Eigen::MatrixXd two(2, 2);
  two << at(0.785, 0.7), at(0.785, 0.5);
  const Eigen::VectorXd logs = density.LogDensity(two);
  EXPECT_GT(logs[0] - logs[1], 3);
  // The chance of a kernel and its draws must be the same density.
  Eigen::MatrixXd fresh(2000, 2);
  for (auto row : fresh.rowwise()) row = density.Draw(random).transpose();
  const double expected = (p * density.LogDensity(square).array()).mean() / p.mean();
  EXPECT_NEAR(density.LogDensity(fresh).mean(), expected, 0.15);
}

// Kernels that are too narrow for their number make hills of chance, which a later campaign takes
// for knowledge. The error is 0.27 to 0.29 over seeds; with a twentieth of the draws to shape each
// kernel, 0.37 to 0.40.
TEST(DrawsDensity, IsNearlyAsSmoothAsWhatItsDrawsAreFrom) {
  constexpr double kSd = 0.1;
  base::Random random(5, base::Stream("ball"));
  const auto normal = [&](int count) {
    Eigen::MatrixXd draws(count, 3);
    for (double& coordinate : draws.reshaped()) coordinate = 0.5 + kSd * random.Normal();
    return draws;
  };
  const DrawsDensity density(normal(1000));
  const Eigen::MatrixXd fresh = normal(1000);
  const Eigen::ArrayXd squared = ((fresh.array() - 0.5) / kSd).square().rowwise().sum();
  const Eigen::ArrayXd error = density.LogDensity(fresh).array() + 0.5 * squared;
  const Eigen::ArrayXd inside = (squared < 6.25).cast<double>();  // 90 % of them
  const double mean = (inside * error).sum() / inside.sum();
  EXPECT_LT(std::sqrt((inside * (error - mean).square()).sum() / inside.sum()), 0.33);
}

// Kernels round unmoved draws left 0.785 of it within the true region of six parameters.
TEST(DrawsDensity, IsAsWideAsItsDraws) {
  // The 0.9 quantile of χ² with 1 to 6 degrees of freedom.
  const std::vector<double> quantile{2.706, 4.605, 6.251, 7.779, 9.236, 10.645};
  for (int d = 1; d <= 6; ++d) {
    base::Random random(7, base::Stream("width of a density"), static_cast<std::uint64_t>(d));
    Eigen::MatrixXd draws(600, d);
    for (double& one : draws.reshaped()) one = 0.5 + 0.08 * random.Normal();
    const DrawsDensity density(draws);
    int inside = 0;
    constexpr int kDraws = 4000;  // the broad kernel's twentieth takes 0.02 of the share
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::VectorXd z = (density.Draw(random).array() - 0.5) / 0.08;
      inside += z.squaredNorm() <= quantile[static_cast<std::size_t>(d - 1)] ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(inside) / kDraws, 0.89, 0.03) << d;
  }
}

// Draws of a half normal that piles up at a face have its density there, not half of it; in a
// corner not a quarter.
TEST(DrawsDensity, KeepsItsMassInTheCube) {
  constexpr double kSd = 0.15;
  base::Random random(7, base::Stream("pile"));
  Eigen::MatrixXd draws(1000, 2);
  for (double& coordinate : draws.reshaped()) coordinate = std::abs(kSd * random.Normal());
  draws.col(1) = 1 - draws.col(1).array();
  const DrawsDensity density(draws);
  Eigen::MatrixXd corner(1, 2);
  corner << 0, 1;
  const double truth = 2 * std::log(2 / (std::sqrt(2 * std::numbers::pi) * kSd));
  // Kernels as wide as 100 of the draws lie take 0.3 of such a peak; without mirrors 1.7 were gone.
  EXPECT_NEAR(density.LogDensity(corner)[0], truth, 0.6);
}

// A valley into a corner, with kernels that lie along it: what is drawn is what has the density.
TEST(DrawsDensity, DrawsWhatItSaysAlsoAtACorner) {
  base::Random random(8, base::Stream("valley"));
  Eigen::MatrixXd draws(400, 3);
  for (auto row : draws.rowwise()) {
    const double along = 0.3 * std::abs(random.Normal());
    row << along, along + 0.05 * random.Normal(), random.Uniform();
    row = row.cwiseAbs().cwiseMin(1);
  }
  const DrawsDensity density(draws);
  const Eigen::MatrixXd cube = RSequence(40000, 3, 1);
  const Eigen::ArrayXd p = density.LogDensity(cube).array().exp();
  EXPECT_NEAR(p.mean(), 1, 0.03);  // 40000 points of a density that fills a tenth of the cube
  Eigen::MatrixXd fresh(4000, 3);
  for (auto row : fresh.rowwise()) row = density.Draw(random).transpose();
  EXPECT_TRUE(fresh.minCoeff() >= 0 && fresh.maxCoeff() <= 1);
  const Eigen::RowVectorXd expected =
      (cube.array().colwise() * p).matrix().colwise().mean() / p.mean();
  // Three standard errors of 4000 draws with sd 0.3.
  EXPECT_LT((fresh.colwise().mean() - expected).cwiseAbs().maxCoeff(), 0.015);
}

ParameterSpace TwoParameters() {
  return {.parameters = {{.name = "friction", .low = 0, .high = 1},
                         {.name = "restitution", .low = 0.2, .high = 1}}};
}

TEST(Prior, ComesWithTheDomainOfASpace) {
  ParameterSpace space = TwoParameters();
  EXPECT_TRUE(space.MakeDomain().prior.IsUniform());
  space.parameters[1].prior = NormalPrior{.mean = 0.6, .sd = 0.1};
  space.parameters[1].is_nuisance = true;
  const Domain domain = space.MakeDomain();
  EXPECT_EQ(domain.nuisances, std::vector<Eigen::Index>{1});
  EXPECT_EQ(domain.Asked(), std::vector<Eigen::Index>{0});
  Eigen::MatrixXd points(2, 2);
  points << 0.3, 0.5, 0.7, 0.625;  // 0.6 and 0.7 of restitution
  const Eigen::VectorXd density = domain.prior.LogDensity(points);
  EXPECT_NEAR(density[0] - density[1], 0.5, 1e-12);
}

TEST(Prior, OfEarlierDrawsLeavesOutWhatLiesOutsideTheRanges) {
  ParameterSpace space = TwoParameters();
  EarlierDraws earlier;
  earlier.names = {"restitution", "friction"};
  for (int i = 0; i < 200; ++i) earlier.values.push_back({0.1 + 0.004 * i, 0.5});
  const Eigen::MatrixXd inside = space.Inside(earlier);
  EXPECT_EQ(inside.rows(), 175);  // those from 0.2 on
  EXPECT_NEAR(inside(0, 0), 0, 1e-12);
  EXPECT_EQ(inside(0, 1), 0.5);
}

TEST(DesignWithNuisances, GrowsLess) {
  Domain domain{.num_parameters = 3};
  EXPECT_EQ(PosteriorDesignSize(domain), 16);
  domain.num_parameters = 6;
  EXPECT_EQ(PosteriorDesignSize(domain), 28);
  domain.nuisances = {3, 4, 5};
  EXPECT_EQ(PosteriorDesignSize(domain), 22);
  for (const Eigen::Index k : domain.nuisances) domain.prior.Add(k, {}, {.mean = 0.5, .sd = 0.03});
  EXPECT_EQ(PosteriorDesignSize(domain), 17);
}

TEST(DesignWithNuisances, LooksForThemWhereTheirPriorIs) {
  Domain domain{.num_parameters = 2, .nuisances = {1}};
  domain.prior.Add(1, {}, {.mean = 0.7, .sd = 0.05});
  double low = 1;
  for (const Eigen::VectorXd& point : PosteriorDesign(domain, 12, 1)) {
    EXPECT_NEAR(point[1], 0.7, 0.2);  // 4 standard deviations
    low = std::min(low, point[0]);
  }
  EXPECT_LT(low, 0.1);  // all over the range of what is asked for
}

}  // namespace prior_test
}  // namespace talus::optimizer
