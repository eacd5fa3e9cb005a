// Numbers that exist at some sets only: what was measured existed, so the answer keeps to these.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "optimizer/designs/r_sequence.h"
#include "optimizer/outputs/success_model.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::optimizer {
namespace defined_numbers_test {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A drum's angle tells x₀. Powder that clings, x₁ > 0.6, has none.
std::vector<double> Angle(const Eigen::VectorXd& x) {
  return {x[1] > 0.6 ? kNone : 30 + 20 * x[0]};
}

PosteriorStrategy Told(int num_simulations) {
  const ExperimentTarget drum{.name = "drum", .scalars = {{"angle", 40, 0.5}}};
  PosteriorStrategy strategy({.scale_factors = {1}, .seed = 1}, {.num_parameters = 2}, {drum});
  const Eigen::MatrixXd points = RSequence(num_simulations, 2, 3);
  for (const auto& row : points.rowwise()) {
    const std::vector<double> angle = Angle(row.transpose());
    const bool undefined = std::isnan(angle[0]);
    strategy.Tell({.point = row.transpose(), .cost = 1, .failed = undefined, .scalars = angle});
  }
  return strategy;
}

// Without this half of the draws would lie where no simulation has an angle: 0.4 of the range of
// x₁, over which the model of the angle goes on as if it were there.
TEST(DefinedNumbers, TheAnswerKeepsToWhereTheyExist) {
  PosteriorStrategy strategy = Told(40);
  const Answer answer = strategy.Recommend();
  ASSERT_TRUE(answer.posterior);
  EXPECT_NEAR(answer.point[0], 0.5, 0.1);
  EXPECT_LT(answer.point[1], 0.6);
  Eigen::MatrixXd line(9, 2);  // from where it exists to where it does not
  for (Eigen::Index i = 0; i < 9; ++i) line.row(i) << 0.5, 0.1 + 0.1 * static_cast<double>(i);
  const Eigen::VectorXd level = strategy.CredibleLevels(line).value();
  EXPECT_LT(level.head(4).maxCoeff(), 0.9);
  EXPECT_GT(level.tail(2).minCoeff(), 0.9);
}

// One of 24 has the angle: first trials at every scale factor, which it has, were said to lack.
TEST(DefinedNumbers, ThatTooFewTrialsHaveANumberIsWhatASearchLacks) {
  const ExperimentTarget drum{.name = "drum", .scalars = {{"angle", 40, 0.5}}};
  PosteriorStrategy strategy({.scale_factors = {1}, .seed = 1}, {.num_parameters = 2}, {drum});
  strategy.Tell({.point = Eigen::Vector2d(0.5, 0.5), .failed = true, .scalars = {kNone}});
  EXPECT_EQ(strategy.Shortfall().value().lack, StopLack::kFirstTrials);
  for (int i = 1; i < 24; ++i) {
    const Eigen::VectorXd point = strategy.AskAt(1, {}).front().point;
    strategy.Tell({.point = point, .failed = i > 1, .scalars = {i > 1 ? kNone : 40}});
  }
  const StopShortfall lacks = strategy.Shortfall().value();
  EXPECT_EQ(lacks.lack, StopLack::kDefined);
  EXPECT_EQ(TextOf(lacks, {}),
            "only 1 of 24 simulations has angle, too few for a model: search "
            "ranges where the test has it");
}

// Too few for a model: by value, which numbers do not have, the first evaluation would be the best.
class Unmodelled : public testing::Test {
 protected:
  // As a campaign tells it: without its only number an evaluation has failed.
  static void Tell(PosteriorStrategy& strategy, double at, int experiment, double number) {
    strategy.Tell({.point = Eigen::Vector2d(at, at),
                   .experiment = experiment,
                   .failed = std::isnan(number),
                   .scalars = {number}});
  }
  static PosteriorStrategy Make(double weight_of_box = 1) {
    const ExperimentTarget drum{.name = "drum", .scalars = {{"angle", 40, 0.5}}};
    const ExperimentTarget box{
        .name = "box", .scalars = {{"slope", 10, 1}}, .weight = weight_of_box};
    return {{.scale_factors = {1}, .seed = 1}, {.num_parameters = 2}, {drum, box}};
  }
};

TEST_F(Unmodelled, TheBestPointIsTheOneThatMeetsAllExperiments) {
  PosteriorStrategy strategy = Make();
  Tell(strategy, 0.2, 0, 20), Tell(strategy, 0.2, 1, 10);
  Tell(strategy, 0.4, 0, kNone), Tell(strategy, 0.4, 1, 11);  // no angle there
  Tell(strategy, 0.6, 0, 39), Tell(strategy, 0.6, 1, 9);
  Tell(strategy, 0.8, 0, 40);  // the box has not been simulated
  const Answer answer = strategy.Recommend();
  EXPECT_FALSE(answer.posterior);
  EXPECT_EQ(answer.point, Eigen::Vector2d(0.6, 0.6));
}

TEST_F(Unmodelled, WhatIsHeldOutDoesNotCount) {
  PosteriorStrategy strategy = Make(0);
  Tell(strategy, 0.2, 0, 40), Tell(strategy, 0.2, 1, 20);
  Tell(strategy, 0.6, 0, 39), Tell(strategy, 0.6, 1, 10);
  EXPECT_EQ(strategy.Recommend().point, Eigen::Vector2d(0.2, 0.2));
}

// Twice beside each other, at the same place: one chance result does not decide.
TEST(SuccessModel, IsSureOnlyOfWhatItHasSeen) {
  Eigen::MatrixXd points(6, 1);
  points << 0.1, 0.11, 0.12, 0.13, 0.9, 0.9;
  Eigen::VectorXd worked(6);
  worked << 1, 1, 1, 0, 0, 0;
  const SuccessModel model(points, worked);
  Eigen::MatrixXd at(3, 1);
  at << 0.12, 0.4, 0.9;
  const Eigen::VectorXd probability = model.Probability(at);
  EXPECT_GT(probability[0], 0.6);                   // three of four
  EXPECT_GT(probability[1], probability[2] + 0.2);  // nobody has been there
  EXPECT_LT(probability[2], 0.2);
  EXPECT_TRUE(SuccessModel(points, Eigen::VectorXd::Ones(6)).always());
  EXPECT_TRUE(SuccessModel().always());
}

}  // namespace defined_numbers_test
}  // namespace talus::optimizer
