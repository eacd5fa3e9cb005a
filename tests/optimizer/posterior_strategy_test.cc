#include "optimizer/strategy/posterior_strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "optimizer/designs/design.h"
#include "optimizer/posterior/branches.h"

namespace talus::optimizer {
namespace posterior_strategy_test {

using testing::ElementsAre;

// A powder whose test has two numbers: sliding and rolling friction together, and their balance.
// Coarse grains change both.
constexpr double kNoise = 0.02;  // sd of one simulation at the target
std::vector<double> Measure(const Eigen::VectorXd& x, double factor, int run) {
  base::Random random(11, base::Stream("numbers"), static_cast<std::uint64_t>(run));
  const double coarse = factor - 1;
  const double noise = kNoise * std::pow(factor, 1.5);
  return {1 + x[0] + x[1] + 0.4 * coarse * x[1] + noise * random.Normal(),
          2 + 0.5 * (x[0] - x[1]) - 0.2 * coarse + noise * random.Normal()};
}

struct Twin {
  Eigen::Vector2d truth{0.45, 0.3};
  std::vector<double> factors{2, 1};
  double target = 0;
  bool balance = true;    // whether the second number is measured
  bool is_drawn = false;  // whether what is measured is off by its error and the model's
  std::uint64_t seed = 1;
  double weight = 1;
  double stop_share = 0.1;
  int simulations = 0;
  double core_time = 0;

  ExperimentTarget MakeTarget() const {
    constexpr double kError = 0.01;
    base::Random random(11, base::Stream("measured"), seed);
    // A model error of 1, PosteriorStrategyOptions' default, is the noise of one simulation.
    const auto error = [&] { return is_drawn ? std::hypot(kError, kNoise) * random.Normal() : 0; };
    const double sum = 1 + truth[0] + truth[1] + error();
    ExperimentTarget made{.name = "twin", .scalars = {{"sum", sum, kError}}};
    const double difference = 2 + 0.5 * (truth[0] - truth[1]) + error();
    if (balance) made.scalars.push_back({"balance", difference, kError});
    made.weight = weight;
    return made;
  }
  std::unique_ptr<PosteriorStrategy> Make() const {
    return std::make_unique<PosteriorStrategy>(PosteriorStrategyOptions{.scale_factors = factors,
                                                                        .target = target,
                                                                        .stop_share = stop_share,
                                                                        .simulations = simulations,
                                                                        .core_time = core_time,
                                                                        .seed = seed},
                                               Domain{.num_parameters = 2},
                                               std::vector{MakeTarget()});
  }
  Observation Simulate(const Proposal& p, int run) const {
    Observation observation{
        .point = p.point,
        .scale_factor = p.scale_factor,
        .cost = std::pow(p.scale_factor, -4),
        .scalars = Measure(p.point, p.scale_factor, run + 1000 * static_cast<int>(seed))};
    if (!balance) observation.scalars.resize(1);
    return observation;
  }
  std::unique_ptr<PosteriorStrategy> Search(int count) const {
    auto strategy = Make();
    for (int i = 0; i < count; ++i) strategy->Tell(Simulate(strategy->AskAt(1, {}).front(), i));
    return strategy;
  }
};

// Evaluations until the search ends by itself.
std::vector<Observation> UntilItStops(const Twin& twin) {
  constexpr std::size_t kMost = 300;
  auto strategy = twin.Make();
  std::vector<Observation> told;
  while (told.size() < kMost && (told.empty() || !strategy->WhyStop())) {
    told.push_back(twin.Simulate(strategy->AskAt(1, {}).front(), static_cast<int>(told.size())));
    strategy->Tell(told.back());
  }
  return told;
}

// Before each proposal, as a campaign asks.
TEST(PosteriorStrategy, ASearchThatIsInterruptedStopsWhereItWouldHaveStopped) {
  const Twin twin{.stop_share = 0.4};
  const std::vector<Observation> told = UntilItStops(twin);
  ASSERT_THAT(told.size(), testing::AllOf(testing::Gt(25), testing::Lt(300)));
  for (std::size_t count = 24; count <= told.size(); ++count) {
    auto resumed = twin.Make();
    for (std::size_t i = 0; i < count; ++i) resumed->Tell(told[i]);
    EXPECT_EQ(resumed->WhyStop().has_value(), count == told.size()) << count;
    EXPECT_EQ(resumed->WhyStop().has_value(), count == told.size());  // asked again
  }
}

// The look at a smaller sample first only saves time.
TEST(PosteriorStrategy, ASearchStopsWhereNoNumberOfEvaluationsWouldNarrowARange) {
  const Twin twin{.stop_share = 0.15};
  const std::vector<Observation> told = UntilItStops(twin);
  ASSERT_LT(told.size(), 300);
  auto asked = twin.Make();
  auto whole = twin.Make();
  for (std::size_t i = 0; i < told.size(); ++i) {
    asked->Tell(told[i]);
    whole->Tell(told[i]);
    const bool is_last = i + 1 == told.size();
    if (i < 24 || (i % 4 != 0 && !is_last)) continue;
    const PosteriorSummary summary = *whole->Recommend().posterior;
    EXPECT_EQ(asked->WhyStop().has_value(),
              summary.surrogate_narrowing < twin.stop_share && summary.temper <= 1.5)
        << i;
  }
}

TEST(PosteriorStrategy, AnswersForTheTargetThatCoarseGrainsMiss) {
  const Twin twin;
  const Answer answer = twin.Search(24)->Recommend();
  // At scale factor 2 the same numbers belong to (0.52, 0.17): 0.15 away.
  EXPECT_LT((answer.point - twin.truth).norm(), 0.06);
  ASSERT_TRUE(answer.posterior);
  EXPECT_EQ(answer.posterior->target_scale_factor, 1);
  EXPECT_FALSE(answer.posterior->is_extrapolated);
  EXPECT_TRUE(answer.posterior->unlearnt_scale_factors.empty());
}

struct Use {
  int simulations = 0;
  double core_time = 0;  // [core s]
};

// What a search has used when either of the two is used up; so many were made before it.
Use UseOf(const Twin& twin, int simulations, double core_time, int reused = 0) {
  const auto strategy = twin.Make();
  Use use;
  for (int i = 0; i < reused; ++i) {
    Observation observation = twin.Simulate(strategy->AskAt(1, {}).front(), 1000 + i);
    observation.is_paid_for = false;
    strategy->Tell(observation);
  }
  while (use.simulations < simulations && use.core_time < core_time) {
    const Observation observation =
        twin.Simulate(strategy->AskAt(1, {}).front(), use.simulations++);
    use.core_time += observation.cost;
    strategy->Tell(observation);
  }
  return use;
}

TEST(PosteriorStrategy, UsesUpTheCoreTimeAndTheNumberWhereBothAreBounded) {
  Twin twin{.factors = {3, 1}};  // a coarse simulation costs an 81st
  const double by_cost = UseOf(twin, 40, 1e9).core_time;
  twin.simulations = 40;
  twin.core_time = 3 * by_cost;
  const Use both = UseOf(twin, 40, twin.core_time);
  EXPECT_GE(both.core_time, 0.9 * twin.core_time);
  EXPECT_GE(both.simulations, 0.75 * 40);  // the step of a fine simulation is 6 % of the time
  // What was made before costs this search neither.
  const Use after = UseOf(twin, 40, twin.core_time, 40);
  EXPECT_GE(after.core_time, 0.9 * twin.core_time);
  EXPECT_GE(after.simulations, 0.75 * 40);
  // A number that is out of reach changes nothing.
  twin.simulations = 1'000'000;
  EXPECT_EQ(UseOf(twin, 40, 1e9).core_time, by_cost);
}

// A model of all of them would take hours.
TEST(PosteriorStrategy, OfManyEvaluationsAPartIsModelled) {
  const Twin twin;
  const auto strategy = twin.Make();
  const Points points = Sobol(3000, 2, 1);
  for (int i = 0; i < 3000; ++i) {
    strategy->Tell(twin.Simulate(
        {.point = points[static_cast<std::size_t>(i)], .scale_factor = i % 2 == 0 ? 2.0 : 1.0}, i));
  }
  // A tenth of the noise of one simulation would be .002; what a part leaves of it is below .03.
  EXPECT_LT((strategy->Recommend().point - twin.truth).norm(), 0.03);
}

// In half of the square every fifth run fails. With the successes alone thinned the model's share
// of these fell to .63 after 600 runs and .39 after 1200.
TEST(PosteriorStrategy, FailuresAreNotThinnedLessThanSuccesses) {
  const Twin twin;
  const auto strategy = twin.Make();
  base::Random random(5, base::Stream("failures"));
  for (int i = 0; i < 800; ++i) {
    const Eigen::Vector2d point(random.Uniform(), random.Uniform());
    Observation observation = twin.Simulate({.point = point, .scale_factor = 1}, i);
    observation.failed = point[0] > 0.5 && random.Uniform() < 0.2;
    strategy->Tell(observation);
  }
  Eigen::MatrixXd points(6, 2);
  points << 0.65, 0.3, 0.75, 0.5, 0.85, 0.7, 0.15, 0.3, 0.2, 0.5, 0.25, 0.7;
  const Eigen::ArrayXd share = strategy->Model().LogSuccess(points).array().exp();
  // 400 of them, each of whose neighbours within a length of .25 are some 40: .06.
  EXPECT_NEAR(share.head(3).mean(), 0.8, 0.08);
  EXPECT_GT(share.tail(3).mean(), 0.95);
}

TEST(PosteriorStrategy, JointRegionsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kTwins = 30;
  int covered = 0;
  double level = 0;
  for (int seed = 1; seed <= kTwins; ++seed) {
    Twin twin{.is_drawn = true, .seed = static_cast<std::uint64_t>(seed)};
    twin.truth = {0.2 + 0.02 * seed, 0.85 - 0.02 * seed};
    const auto standing = twin.Search(36)->Consider(twin.truth);
    covered += standing->credible_level <= 0.9 ? 1 : 0;
    level += standing->credible_level / kTwins;
  }
  // Where regions are right 27 ± 1.6 hold the truth, and its mean level is 0.5 ± 0.053: three of
  // these. The level is low where regions are too wide.
  EXPECT_GE(covered, 22);
  EXPECT_NEAR(level, 0.5, 0.16);
}

// A Gaussian to the power 4 has half the standard deviation: a quarter of the area in two
// parameters. The tails are heavier than that, and the region's edge is drawn from a sample.
TEST(PosteriorStrategy, AWeightIsThePowerOfTheLikelihood) {
  Twin twin;
  std::vector<Observation> told;
  const auto strategy = twin.Make();
  for (int i = 0; i < 24; ++i) {
    told.push_back(twin.Simulate(strategy->AskAt(1, {}).front(), i));
    strategy->Tell(told.back());
  }
  const double once = strategy->Recommend().posterior.value().region_volume;
  twin.weight = 4;
  const auto weighted = twin.Make();
  for (const Observation& observation : told) weighted->Tell(observation);
  const double four = weighted->Recommend().posterior.value().region_volume;
  EXPECT_GT(four, 0.12 * once);
  EXPECT_LT(four, 0.5 * once);
  // Whether a set fits is another question than how much it counts.
  EXPECT_EQ(weighted->Consider(twin.truth)->experiments[0].implausibility,
            strategy->Consider(twin.truth)->experiments[0].implausibility);
}

// What the outlook of a search says of half as many evaluations again, and what they do.
TEST(PosteriorStrategy, RangesNarrowAsMuchAsTheOutlookExpects) {
  constexpr int kTwins = 16;
  double expected = 0;
  double found = 0;
  for (int seed = 1; seed <= kTwins; ++seed) {
    Twin twin{.seed = static_cast<std::uint64_t>(seed), .stop_share = 1e-9};
    twin.truth = {0.3 + 0.02 * seed, 0.7 - 0.02 * seed};
    const auto strategy = twin.Search(20);
    const auto outlook = strategy->Shortfall();
    ASSERT_TRUE(outlook);
    ASSERT_EQ(outlook->num_more, 10);
    ASSERT_EQ(outlook->narrowing.size(), 2U);
    const Answer before = strategy->Recommend();
    for (int i = 0; i < 10; ++i) {
      strategy->Tell(twin.Simulate(strategy->AskAt(1, {}).front(), 20 + i));
    }
    const Answer after = strategy->Recommend();
    for (std::size_t k = 0; k < 2; ++k) {
      const auto width = [k](const Answer& a) { return a.credible[k].high - a.credible[k].low; };
      expected += (1 - outlook->narrowing[k]) / (2 * kTwins);
      found += width(after) / width(before) / (2 * kTwins);
    }
  }
  EXPECT_LT(expected, 0.95);  // there is something to foretell
  EXPECT_NEAR(std::log((1 - found) / (1 - expected)), 0, std::log(1.5));
}

TEST(PosteriorStrategy, OneNumberLeavesAValleyInOnePiece) {
  const Twin twin{.balance = false};
  const Answer answer = twin.Search(40)->Recommend();
  const PosteriorBranch& branch = answer.posterior->branches.front();
  EXPECT_EQ(answer.posterior->branches.size(), 1U);
  // The whole line x + y = 0.75 is left, from one edge of the box to the other.
  EXPECT_GT(branch.high[0] - branch.low[0], 0.5);
  EXPECT_LT(answer.correlation(0, 1), -0.9);
  EXPECT_NEAR(answer.point.sum(), 0.75, 0.1);
}

TEST(PosteriorStrategy, SpendsMostSimulationsOnCheapGrainsButLearnsTheDiscrepancy) {
  const Twin twin;
  auto strategy = twin.Make();
  int fine = 0;
  for (int i = 0; i < 24; ++i) {
    const Proposal p = strategy->AskAt(1, {}).front();
    fine += p.scale_factor == 1 ? 1 : 0;
    strategy->Tell(twin.Simulate(p, i));
  }
  EXPECT_GE(fine, 3);
  EXPECT_LE(fine, 12);
}

TEST(PosteriorStrategy, ToldTheSameItProposesTheSame) {
  const Twin twin;
  auto first = twin.Make();
  std::vector<Observation> told;
  for (int i = 0; i < 17; ++i) {
    told.push_back(twin.Simulate(first->AskAt(1, {}).front(), i));
    first->Tell(told.back());
  }
  auto second = twin.Make();
  for (const Observation& observation : told) second->Tell(observation);
  const Proposal a = first->AskAt(1, {}).front();
  const Proposal b = second->AskAt(1, {}).front();
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.scale_factor, b.scale_factor);
  EXPECT_EQ(first->Recommend().point, second->Recommend().point);
}

TEST(PosteriorStrategy, BatchesDoNotRepeatThemselves) {
  const Twin twin;
  auto strategy = twin.Search(16);
  const auto batch = strategy->AskAt(4, {});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((batch[i].point - batch[j].point).norm(), 1e-6) << i << " and " << j;
    }
  }
}

TEST(PosteriorStrategy, SaysThatItExtrapolates) {
  const Twin twin{.factors = {3, 2, 1.5}, .target = 1};
  const auto strategy = twin.Search(30);
  const Answer answer = strategy->Recommend();
  EXPECT_TRUE(answer.posterior->is_extrapolated);
  EXPECT_EQ(answer.posterior->target_scale_factor, 1);
  // The region is as wide as the growth of the discrepancy leaves it, and holds the truth.
  EXPECT_LE(strategy->Consider(twin.truth)->credible_level, 0.9);
  EXPECT_LT((answer.point - twin.truth).norm(), 0.15);
}

TEST(PosteriorStrategy, NamesScaleFactorsWithoutEvaluations) {
  const Twin twin;
  auto strategy = twin.Make();
  for (int i = 0; i < 12; ++i) strategy->Tell(twin.Simulate(strategy->AskAt(1, {}).front(), i));
  EXPECT_THAT(strategy->Recommend().posterior->unlearnt_scale_factors, ElementsAre(1));
}

TEST(PosteriorStrategy, FailedSimulationsAreNotProposedAgain) {
  const Twin twin;
  auto strategy = twin.Make();
  for (int i = 0; i < 20; ++i) {
    const Proposal p = strategy->AskAt(1, {}).front();
    if (p.point[0] > 0.7) {
      strategy->Tell({.point = p.point, .scale_factor = p.scale_factor, .failed = true});
    } else {
      strategy->Tell(twin.Simulate(p, i));
    }
  }
  EXPECT_LT(strategy->Recommend().point[0], 0.7);
  for (const Proposal& p : strategy->AskAt(4, {})) EXPECT_LT(p.point[0], 0.75);
}

// A drum that never shows a surface has no angle: the search goes on with its design, and answers
// what it can.
TEST(PosteriorStrategy, ANumberThatIsNeverDefinedEndsNoSearch) {
  const Twin twin{.stop_share = 1e-9};
  auto strategy = twin.Make();
  for (int i = 0; i < 24; ++i) {
    Observation told = twin.Simulate(strategy->AskAt(1, {}).front(), i);
    if (i < 16) told.scalars[1] = std::numeric_limits<double>::quiet_NaN();
    strategy->Tell(told);
    if (i != 15) continue;
    EXPECT_FALSE(strategy->Recommend().posterior.has_value());
  }
  EXPECT_TRUE(strategy->Recommend().posterior.has_value());
  // None of the first two thirds had it: of them there is no model to compare with.
  EXPECT_TRUE(strategy->Shortfall().has_value());
}

TEST(PosteriorStrategy, TwoExperimentsAreEachSimulatedAndDecideTogether) {
  const Twin one{.balance = false};
  std::vector<ExperimentTarget> targets{one.MakeTarget()};
  targets.push_back({.name = "second", .scalars = {{"balance", 2.075, 0.01}}});
  PosteriorStrategy strategy({.scale_factors = {2, 1}, .seed = 3}, {.num_parameters = 2}, targets);
  std::array<int, 2> count{};
  for (int i = 0; i < 44; ++i) {
    const Proposal p = strategy.AskAt(1, {}).front();
    ++count.at(static_cast<std::size_t>(p.experiment));
    const std::vector<double> both = Measure(p.point, p.scale_factor, i);
    strategy.Tell({.point = p.point,
                   .experiment = p.experiment,
                   .scale_factor = p.scale_factor,
                   .cost = std::pow(p.scale_factor, -4),
                   .scalars = {both[static_cast<std::size_t>(p.experiment)]}});
  }
  EXPECT_GE(std::min(count[0], count[1]), 12);
  const Answer answer = strategy.Recommend();
  EXPECT_LT((answer.point - one.truth).norm(), 0.1);
  EXPECT_THAT(answer.posterior->experiments, testing::SizeIs(2));
}

}  // namespace posterior_strategy_test
}  // namespace talus::optimizer
