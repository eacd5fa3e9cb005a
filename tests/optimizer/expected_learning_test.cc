#include "optimizer/posterior/expected_learning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace talus::optimizer {
namespace expected_learning_test {

Eigen::MatrixXd Even(Eigen::Index count) {
  base::Random random(5, base::Stream("even draws"));
  Eigen::MatrixXd draws(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) draws.row(i) << random.Uniform(), random.Uniform();
  return draws;
}

TEST(ExpectedLearning, NothingMeasuredTeachesNothing) {
  const ExpectedLearning learning =
      Learn(Even(500), {.mean = Eigen::MatrixXd(500, 0), .variance = {}}, 1);
  EXPECT_EQ(learning.bits, 0);
  EXPECT_GT(learning.width.minCoeff(), 0.9);
  EXPECT_EQ(learning.narrow, learning.width);
  EXPECT_EQ(learning.wide, learning.width);
}

TEST(ExpectedLearning, BitsAreThoseOfALinearGaussianMeasurement) {
  // Cov of one uniform parameter is 1/12; 5 % is over twice the error of a variance of 4000 draws.
  const Eigen::MatrixXd draws = Even(4000);
  const double variance = 0.01;
  const ExpectedLearning learning =
      Learn(draws, {.mean = draws.col(0), .variance = Eigen::VectorXd::Constant(1, variance)}, 1);
  EXPECT_NEAR(learning.bits, 0.5 * std::log2(1 + 1 / (12 * variance)), 0.05);
}

TEST(ExpectedLearning, NarrowsWhatItMeasuresAndNothingElse) {
  const Eigen::MatrixXd draws = Even(2000);
  const double sd = 0.03;
  const ExpectedLearning learning =
      Learn(draws, {.mean = draws.col(0), .variance = Eigen::VectorXd::Constant(1, sd * sd)}, 1);
  // A joint 90 % range of two parameters covers about 95 % of each: ± 2 to 2.5 sd with heavy tails;
  // the other keeps its own 95 %.
  EXPECT_GT(learning.width[0], 3.5 * sd);
  EXPECT_LT(learning.width[0], 5.5 * sd);
  EXPECT_GT(learning.width[1], 0.85);
}

// The draw that is taken for the truth took nearly all the weight of so telling a measurement, and
// its twin would. The true range is that of two normals, ± 2.2 sd with heavy tails, of many draws.
TEST(ExpectedLearning, TheTruthIsNoneOfTheDrawsThatAreWeighted) {
  const double sd = 0.01;
  const auto width = [&](const Eigen::MatrixXd& draws) {
    return Learn(draws, {.mean = draws, .variance = Eigen::VectorXd::Constant(2, sd * sd)}, 1)
        .width.mean();
  };
  const Eigen::MatrixXd draws = Even(1000);
  const Eigen::MatrixXd twice = (Eigen::MatrixXd(2000, 2) << draws, draws).finished();
  // A handful of the 1000 lie within, which span less than the range.
  const double true_width = width(Even(40000));
  EXPECT_GT(width(draws) / true_width, 0.6);
  EXPECT_GT(width(twice) / true_width, 0.6);
}

// x⁴ has a slope of 4 at 1, and below 0.4 less than an error in all: what it leaves hangs on the
// set.
TEST(ExpectedLearning, SaysHowFarTheRangesHangOnTheSet) {
  const Eigen::MatrixXd draws = Even(2000);
  const double sd = 0.03;
  const ExpectedLearning learning = Learn(
      draws,
      {.mean = draws.col(0).array().pow(4), .variance = Eigen::VectorXd::Constant(1, sd * sd)}, 1);
  EXPECT_LT(learning.narrow[0],
            5.5 * sd / 2);  // a tenth of the sets: x above 0.9, slopes above 2.9
  EXPECT_GT(learning.wide[0], 0.4);
  EXPECT_LT(learning.narrow[0], learning.width[0]);
  EXPECT_GT(learning.wide[0], learning.width[0]);
  EXPECT_GT(learning.narrow[1], 0.8);  // the other parameter is not measured, whatever the set
}

// The same, when the set is known: slopes of 2.05 at 0.8 and of 0.5 at 0.5, and ranges of ± 2
// to 2.75 sd of a measurement with that slope.
TEST(ExpectedLearning, SaysWhatIsLeftWhereASetIsSupposed) {
  const Eigen::MatrixXd draws = Even(4000);
  const double sd = 0.01;
  const auto width = [&](double x) {
    return Learn(draws,
                 {.mean = draws.col(0).array().pow(4),
                  .variance = Eigen::VectorXd::Constant(1, sd * sd),
                  .supposed = Eigen::MatrixXd::Constant(64, 1, std::pow(x, 4))},
                 1)
        .width;
  };
  EXPECT_GT(width(0.8)[0], 4 * sd / 2.05);
  EXPECT_LT(width(0.8)[0], 5.5 * sd / 2.05);
  EXPECT_GT(width(0.5)[0], 4 * sd / 0.5);
  EXPECT_LT(width(0.5)[0], 5.5 * sd / 0.5 * 1.25);  // it bends: flatter below
  EXPECT_GT(width(0.8)[1], 0.8);
}

// A number that only the second parameter moves is narrowed by what measures that one: for a wide
// posterior to 1.64 sd, somewhat more with heavy tails.
TEST(ExpectedLearning, AGoalIsNarrowedByWhatMeasuresItAlone) {
  const Eigen::MatrixXd draws = Even(2000);
  const Eigen::VectorXd goal = 10 * draws.col(1);
  const double sd = 0.03;
  const auto learn = [&](Eigen::Index parameter) {
    return Learn(draws,
                 {.mean = draws.col(parameter), .variance = Eigen::VectorXd::Constant(1, sd * sd)},
                 1, {.goal = goal});
  };
  EXPECT_NEAR(HalfWidth90(goal), 4.5, 0.1);
  EXPECT_NEAR(learn(0).goal_half_width, 4.5, 0.3);
  EXPECT_GT(learn(1).goal_half_width, 1.5 * 10 * sd);
  EXPECT_LT(learn(1).goal_half_width, 2.5 * 10 * sd);
  EXPECT_TRUE(std::isnan(
      Learn(draws, {.mean = draws, .variance = Eigen::Vector2d(1, 1)}, 1).goal_half_width));
}

// Joint ranges of two parameters hold 95 % of each; of one beside a nuisance, 90 % of each.
TEST(ExpectedLearning, ANuisanceDoesNotWidenTheRangesOfWhatIsAskedFor) {
  const PredictedMeasurement none{.mean = Eigen::MatrixXd(2000, 0), .variance = {}};
  const Eigen::MatrixXd draws = Even(2000);
  EXPECT_NEAR(Learn(draws, none, 1).width[0], 0.949, 0.02);
  const ExpectedLearning learning = Learn(draws, none, 1, {.nuisances = {1}});
  EXPECT_NEAR(learning.width[0], 0.9, 0.02);
  EXPECT_NEAR(learning.width[1], 0.9, 0.02);
}

TEST(ExpectedLearning, BetterMeasurementsTeachMore) {
  const Eigen::MatrixXd draws = Even(1000);
  const auto learn = [&](double sd) {
    return Learn(draws, {.mean = draws, .variance = Eigen::VectorXd::Constant(2, sd * sd)}, 1);
  };
  EXPECT_GT(learn(0.05).bits, learn(0.1).bits + 1.5);  // each parameter nearly one bit more
  EXPECT_LT(learn(0.05).width.sum(), learn(0.1).width.sum());
}

// Half of the sets are told to a fiftieth of what is searched, of the others only that they are
// those: half of the volume is left of these, a quarter in the mean. The product of the mean ranges
// would be an eighth.
TEST(ExpectedLearning, ATestThatIsSilentForHalfOfTheSetsLeavesAQuarterOfTheVolume) {
  const Eigen::MatrixXd draws = Even(4000);
  Eigen::MatrixXd mean = draws;
  for (auto row : mean.rowwise()) {
    if (row[0] < 0.5) row.setConstant(-1);
  }
  const ExpectedLearning learning =
      Learn(draws, {.mean = mean, .variance = Eigen::VectorXd::Constant(2, 4e-4)}, 1);
  // Three standard deviations of a share of a half of 64 truths are 0.19, times the half that is
  // left.
  EXPECT_NEAR(learning.volume, 0.25, 0.1);
  EXPECT_LT(learning.width[0] * learning.width[1], 0.7 * learning.volume);
}

// What tells a nuisance alone has the more bits, and leaves all of what is asked for.
TEST(ExpectedLearning, WhatIsLearntOfANuisanceLeavesTheVolume) {
  const Eigen::MatrixXd draws = Even(4000);
  const auto learn = [&](Eigen::Index column, double sd) {
    return Learn(draws,
                 {.mean = draws.col(column), .variance = Eigen::VectorXd::Constant(1, sd * sd)}, 1,
                 {.nuisances = {1}});
  };
  const ExpectedLearning nuisance = learn(1, 0.005);
  const ExpectedLearning asked = learn(0, 0.05);
  EXPECT_GT(nuisance.bits, asked.bits + 2);
  EXPECT_GT(nuisance.volume, 0.9);
  EXPECT_LT(asked.volume, 0.3);
}

TEST(ExpectedLearning, NamesTheTwoDrawsThatItTellsApartBest) {
  Eigen::MatrixXd draws = Even(100);
  draws(17, 0) = -1;
  draws(42, 0) = 2;
  const ExpectedLearning learning =
      Learn(draws, {.mean = draws.col(0), .variance = Eigen::VectorXd::Ones(1)}, 1);
  EXPECT_EQ(learning.first, 17);
  EXPECT_EQ(learning.second, 42);
}

}  // namespace expected_learning_test
}  // namespace talus::optimizer
