// Model errors that are learnt: found where no set fits, left to the prior where one always does.
#include "optimizer/posterior/learn_model_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/random.h"
#include "optimizer/designs/design.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::optimizer {
namespace learn_model_errors_test {

constexpr double kNoise = 0.02;  // sd of one simulation
constexpr int kNumbers = 8;      // of the test: more than parameters, so that no set need fit

// Numbers of a test that are linear in the parameters, in directions evenly round the circle.
std::vector<double> Measure(const Eigen::Vector2d& x, int count) {
  std::vector<double> numbers;
  for (int k = 0; k < count; ++k) {
    const double angle = 0.3 + 0.4 * k;
    numbers.push_back(2 + std::cos(angle) * x[0] + std::sin(angle) * x[1]);
  }
  return numbers;
}

// A campaign told 40 simulations of a powder whose real test is `off` noise sds away from what the
// simulation of the true set gives, up and down in turn.
struct Campaign {
  double off = 0;
  int num_numbers = kNumbers;
  bool learn = true;
  double scale = 1;
  std::uint64_t seed = 1;

  std::unique_ptr<PosteriorStrategy> Make() const {
    const Eigen::Vector2d truth(0.45, 0.3);
    ExperimentTarget target{.name = "test"};
    const std::vector<double> real = Measure(truth, num_numbers);
    base::Random measured(seed, base::Stream("measured"));
    for (int k = 0; k < num_numbers; ++k) {
      const double error = (k % 2 == 0 ? off : -off) * kNoise + 0.2 * kNoise * measured.Normal();
      target.scalars.push_back({.name = "n" + std::to_string(k),
                                .value = real[static_cast<std::size_t>(k)] + error,
                                .standard_error = 0.2 * kNoise});
    }
    auto strategy = std::make_unique<PosteriorStrategy>(
        PosteriorStrategyOptions{
            .model_error = scale, .learn_model_error = learn, .stop_share = 0, .seed = seed},
        Domain{.num_parameters = 2}, std::vector{target});
    base::Random random(seed, base::Stream("simulated"));
    for (const Eigen::VectorXd& x : LatinHypercube(40, 2, seed)) {
      std::vector<double> numbers = Measure(x, num_numbers);
      for (double& n : numbers) n += kNoise * random.Normal();
      strategy->Tell({.point = x, .scale_factor = 1, .cost = 1, .scalars = numbers});
    }
    return strategy;
  }
  ModelError Learnt() const { return Make()->Model().models().front().model_error(); }
};

TEST(LearnModelErrors, FindsHowFarTheRealTestIsFromEverySet) {
  const ModelError none = Campaign{}.Learnt();
  EXPECT_LT(none.value, 0.8);
  EXPECT_GT(none.told, 0.2);
  // A prior of scale 1 holds five back, and heavy tails take much of it for single odd outputs.
  const ModelError five = Campaign{.off = 5}.Learnt();
  EXPECT_GT(five.value, none.value + 0.4);
  EXPECT_LT(five.value, 5);
  // A wide prior leaves it where the residuals put it: six of eight numbers are left over when two
  // parameters are fitted, which tells a standard deviation to 1/√12 = 30 %.
  const ModelError wide = Campaign{.off = 5, .scale = 5}.Learnt();
  EXPECT_NEAR(wide.value, 5, 2);
}

// What the data tell has a width of its own: nodes that follow the prior's scale stepped over it,
// and a prior ten times as wide taught an error of 0.
TEST(LearnModelErrors, AWiderPriorTeachesWhatTheDataTell) {
  for (const double off : {0.0, 0.5}) {
    std::vector<double> learnt;
    for (const double scale : {1.0, 3.0, 10.0}) {
      double mean = 0;
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        mean += Campaign{.off = off, .scale = scale, .seed = seed}.Learnt().value / 3;
      }
      learnt.push_back(mean);
    }
    // Its own posterior is skewed, so that a prior of 1 takes a fifth or so of it away.
    EXPECT_GT(learnt[0], 0.1) << off;
    EXPECT_NEAR(learnt[1] / learnt[0], 1.1, 0.35) << off;
    EXPECT_NEAR(learnt[2] / learnt[1], 1, 0.15) << off;
  }
}

TEST(LearnModelErrors, ASingleNumberThatSomeSetAlwaysMeetsLeavesThePriorAsItIs) {
  const ModelError learnt = Campaign{.num_numbers = 1}.Learnt();
  EXPECT_NEAR(learnt.value, 1, 0.15);  // the valley narrows at the ends of the ranges
  EXPECT_LT(learnt.told, 0.2);
}

TEST(LearnModelErrors, ARegionHoldsTheTruthOfAPowderThatNoSetMatches) {
  const Eigen::Vector2d truth(0.45, 0.3);
  int stated = 0;
  int learnt = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Campaign campaign{.off = 4, .learn = false, .seed = seed};
    stated += (*campaign.Make()->CredibleLevels(truth.transpose()))[0] <= 0.9;
    campaign.learn = true;
    learnt += (*campaign.Make()->CredibleLevels(truth.transpose()))[0] <= 0.9;
  }
  EXPECT_GE(learnt, 5);
  EXPECT_GE(learnt, stated);
}

TEST(LearnModelErrors, DisagreementIsJudgedByTheStatedErrorAndDoesNotHide) {
  const Eigen::Vector2d truth(0.45, 0.3);
  const auto stated = Campaign{.off = 5, .learn = false}.Make();
  const auto learnt = Campaign{.off = 5}.Make();
  EXPECT_NEAR(learnt->Model().models()[0].Misfit(truth), stated->Model().models()[0].Misfit(truth),
              1e-12);
}

TEST(LearnModelErrors, SameEvaluationsMakeTheSameBits) {
  EXPECT_EQ(Campaign{.off = 2}.Learnt().value, Campaign{.off = 2}.Learnt().value);
}

}  // namespace learn_model_errors_test
}  // namespace talus::optimizer
