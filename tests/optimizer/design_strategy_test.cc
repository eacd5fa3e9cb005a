#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "optimizer/strategy/make_strategy.h"
#include "surrogate/same_point.h"
#include "tests/error_in.h"

namespace talus::optimizer {
namespace design_strategy_test {

using ::testing::HasSubstr;

double Bowl(const Eigen::VectorXd& u) { return (u.array() - 0.4).square().sum(); }

// Runs a strategy to its end in batches and returns what it asked for, in order.
std::vector<Eigen::VectorXd> RunToTheEnd(Strategy& strategy, int batch) {
  std::vector<Eigen::VectorXd> asked;
  while (!strategy.WhyStop()) {
    const auto proposals = strategy.Ask(batch, {});
    EXPECT_FALSE(proposals.empty());
    if (proposals.empty()) break;
    for (const Proposal& p : proposals) {
      asked.push_back(p.point);
      strategy.Tell({.point = p.point, .value = Bowl(p.point)});
    }
  }
  return asked;
}

// A campaign of 300 images of a megapixel would keep 1.2 GB: a cleared vector keeps its memory.
TEST(Observation, KeptWithoutItsImageTakesNoMemoryForIt) {
  const Observation kept =
      WithoutImage({.point = Eigen::Vector2d(1, 2), .value = 3, .field = {0, 1}});
  EXPECT_EQ(kept.field.capacity(), 0u);
  EXPECT_EQ(kept.point, Eigen::Vector2d(1, 2));
  EXPECT_EQ(kept.value, 3);
}

StrategyOptions Grid(std::vector<int> levels, int refine_best) {
  return {.kind = StrategyKind::kGrid, .levels = std::move(levels), .refine_best = refine_best};
}

TEST(GridStrategy, SweepsThenRefinesTheBestAndSaysSo) {
  const Domain domain{.num_parameters = 3};
  const auto strategy = MakeStrategy(Grid({8, 8, 9}, 20), domain, nullptr, 1);
  const auto asked = RunToTheEnd(*strategy, 7);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) ASSERT_FALSE(surrogate::SamePoint(asked[i], asked[j]));
  }
  EXPECT_GT(asked.size(), 576u + 26u);
  EXPECT_LE(asked.size(), 576u + 20u * 26u);
  EXPECT_THAT(TextOf(*strategy->WhyStop()),
              HasSubstr("576 points of the grid and " + std::to_string(asked.size() - 576)));
  // Nowhere on grid or half grid is a point nearer to the minimum than half a half step.
  const Eigen::Vector3d quarter(1.0 / 28, 1.0 / 28, 1.0 / 32);
  const Answer answer = strategy->Recommend();
  EXPECT_TRUE(((answer.point.array() - 0.4).abs() <= quarter.array() + 1e-12).all());
}

TEST(GridStrategy, WaitsForTheSweepBeforeItRefines) {
  const auto strategy = MakeStrategy(Grid({2}, 1), Domain{.num_parameters = 1}, nullptr, 1);
  const auto first = strategy->Ask(4, {});
  ASSERT_EQ(first.size(), 2u);
  const std::vector<Eigen::VectorXd> pending{first[1].point};
  strategy->Tell({.point = first[0].point, .value = 1});
  EXPECT_TRUE(strategy->Ask(4, pending).empty());
  EXPECT_FALSE(strategy->WhyStop());
  strategy->Tell({.point = first[1].point, .failed = true});  // a failure is not refined
  const auto refined = strategy->Ask(4, {});
  ASSERT_EQ(refined.size(), 1u);
  EXPECT_EQ(refined[0].point[0], 0.5);
}

TEST(DesignStrategy, AsksForEachPointOnceAndSkipsPendingOnes) {
  for (const StrategyKind kind : {StrategyKind::kLhs, StrategyKind::kSobol}) {
    const StrategyOptions options{.kind = kind, .num_points = 12};
    const Domain domain{.num_parameters = 2};
    const auto strategy = MakeStrategy(options, domain, nullptr, 3);
    const auto first = strategy->Ask(1, {});
    const std::vector<Eigen::VectorXd> pending{first[0].point};
    EXPECT_FALSE(surrogate::SamePoint(strategy->Ask(1, pending)[0].point, first[0].point));
    EXPECT_EQ(RunToTheEnd(*strategy, 5).size(), 12u);
    EXPECT_TRUE(strategy->Ask(1, {}).empty());
  }
}

TEST(DesignStrategy, TakesGuessesFirstAndKeepsToTheDomain) {
  Domain domain{.num_parameters = 2, .guesses = {Eigen::Vector2d(0.1, 0.2)}};
  domain.feasible = [](const Eigen::VectorXd& u) { return u.sum() < 0.5; };
  const auto strategy =
      MakeStrategy({.kind = StrategyKind::kSobol, .num_points = 20}, domain, nullptr, 3);
  const auto asked = RunToTheEnd(*strategy, 4);
  EXPECT_EQ(asked.front(), Eigen::Vector2d(0.1, 0.2));
  EXPECT_EQ(asked.size(), 21u);  // the sequence goes on until 20 are inside
  for (const auto& point : asked) EXPECT_LT(point.sum(), 0.5);
}

TEST(MakeStrategy, EveryKindHasANameAndProposesAPoint) {
  // Kinds are numbered from 0 without gaps, so the list of names is complete if it counts on.
  int count = 0;
  for (const auto& [name, kind] : base::Names<StrategyKind>::kList) {
    EXPECT_EQ(static_cast<int>(kind), count++) << name;
    const StrategyOptions options{.kind = kind};
    const FieldObjective field{
        .width = 2, .height = 2, .target = std::vector<float>(4), .sad_scale = 1};
    const auto strategy = MakeStrategy(options, Domain{.num_parameters = 2}, &field, 1);
    EXPECT_EQ(strategy->Ask(1, {}).size(), 1u) << name;
  }
  EXPECT_EQ(count, static_cast<int>(StrategyKind::kNelderMead) + 1);
}

TEST(MakeStrategy, RefusesOptionsThatCannotBe) {
  const auto error_of = [](const StrategyOptions& options) {
    return ErrorIn([&] { MakeStrategy(options, Domain{.num_parameters = 6}, nullptr, 1); });
  };
  EXPECT_THAT(error_of({.kind = StrategyKind::kGrid, .levels = {3, 3}}),
              HasSubstr("has 2 numbers for 6 parameters"));
  EXPECT_THAT(error_of({.kind = StrategyKind::kGrid}), HasSubstr("must be at most 10000"));
  EXPECT_THAT(error_of({.num_points = 0}), HasSubstr("num_points: is 0"));
}

// They ended in Eigen's assertions or a crash, or were searched outside the cube.
TEST(MakeStrategy, RefusesADomainThatCannotBe) {
  const auto error_of = [](const Domain& domain, StrategyKind kind = StrategyKind::kGp) {
    return ErrorIn([&] { MakeStrategy({.kind = kind}, domain, nullptr, 1); });
  };
  EXPECT_EQ(error_of({.num_parameters = 0}), "domain.num_parameters: is 0, must be from 1 to 6");
  EXPECT_THAT(error_of({.num_parameters = -1}, StrategyKind::kGrid), HasSubstr("is -1"));
  EXPECT_THAT(error_of({.num_parameters = 7}), HasSubstr("is 7"));
  EXPECT_EQ(error_of({.num_parameters = 2, .guesses = {Eigen::Vector3d(0.1, 0.2, 0.3)}}),
            "domain.guesses[0]: has 3 coordinates for 2 parameters: give one for each");
  const std::string outside = "lies outside the unit cube";
  EXPECT_THAT(error_of({.num_parameters = 2, .guesses = {Eigen::Vector2d(1.5, 1.5)}}),
              HasSubstr("domain.guesses[0]: " + outside));
  EXPECT_THAT(error_of({.num_parameters = 2, .candidates = Eigen::MatrixXd::Zero(4, 3)}),
              HasSubstr("domain.candidates: has 3 columns for 2 parameters"));
  EXPECT_THAT(error_of({.num_parameters = 1, .candidates = Eigen::Vector3d(0, 0.5, 20)}),
              HasSubstr("domain.candidates[2]: " + outside));
  EXPECT_THAT(error_of({.num_parameters = 2, .levels = {{0, 1}}}),
              HasSubstr("domain.levels: has 1 lists for 2 parameters"));
  EXPECT_THAT(error_of({.num_parameters = 1, .levels = {{1, 0.5, 0}}}),
              HasSubstr("domain.levels[0]: must be ascending"));
  EXPECT_THAT(error_of({.num_parameters = 1, .levels = {{0, 20}}}), HasSubstr(outside));
  EXPECT_THAT(error_of({.num_parameters = 2, .nuisances = {2}}), HasSubstr("domain.nuisances"));
  EXPECT_THAT(error_of({.num_parameters = 2, .added = {{.coordinate = 2}}}),
              HasSubstr("domain.added"));
}

TEST(MakeStrategy, TakesADomainThatRoundingHasTouched) {
  const double beyond = 1 + std::numeric_limits<double>::epsilon();
  const Domain domain{.num_parameters = 2,
                      .guesses = {Eigen::Vector2d(-1e-17, beyond)},
                      .levels = {{}, {0, 0.5, beyond}}};
  EXPECT_EQ(MakeStrategy({.kind = StrategyKind::kGp}, domain, nullptr, 1)->Ask(1, {}).size(), 1u);
}

TEST(MakeStrategy, RefusesAnObjectiveOfImagesThatCannotBe) {
  const auto error_of = [](const FieldObjective& field) {
    return ErrorIn([&] { MakeStrategy({}, Domain{.num_parameters = 2}, &field, 1); });
  };
  EXPECT_THAT(error_of({}), HasSubstr("field.width: is 0, must be at least 1"));
  const FieldObjective sound{
      .width = 3, .height = 3, .target = std::vector<float>(9), .sad_scale = 1};
  EXPECT_EQ(error_of(sound), "");
  FieldObjective wrong = sound;
  wrong.target.resize(3);
  EXPECT_EQ(error_of(wrong), "field.target: has 3 pixels, must have 3 x 3");
  wrong.target.assign(9, 255);
  EXPECT_THAT(error_of(wrong), HasSubstr("field.target: must have values from 0 to 1"));
  wrong = sound;
  wrong.sad_scale = 0;
  EXPECT_THAT(error_of(wrong), HasSubstr("field.sad_scale: is 0, must be positive"));
  wrong.target.clear();
  wrong.metric = [](std::span<const float> field) { return static_cast<double>(field[0]); };
  EXPECT_EQ(error_of(wrong), "");  // neither is needed by a metric of its own
  wrong.num_target_heaps = -1;
  EXPECT_THAT(error_of(wrong), HasSubstr("num_target_heaps"));
}

TEST(MakeStrategy, RefusesAGridThatConstraintsLeaveWithoutAPoint) {
  Domain domain{.num_parameters = 2};
  domain.feasible = [](const Eigen::VectorXd& u) { return u.sum() > 0.9 && u.sum() < 0.95; };
  EXPECT_THAT(ErrorIn([&] {
                MakeStrategy({.kind = StrategyKind::kGrid, .levels = {2, 2}}, domain, nullptr, 1);
              }),
              HasSubstr("no point meets the constraints"));
}

}  // namespace design_strategy_test
}  // namespace talus::optimizer
