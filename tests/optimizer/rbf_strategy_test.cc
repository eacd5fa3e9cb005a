#include "optimizer/strategy/rbf_strategy.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "optimizer/strategy/make_strategy.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace rbf_strategy_test {

double Bowl(const Eigen::VectorXd& u) { return (u - Eigen::Vector2d(0.3, 0.6)).squaredNorm(); }

double RunFor(Strategy& strategy, int num_evaluations, double noise) {
  for (int i = 0; i < num_evaluations; ++i) {
    base::Random random(static_cast<std::uint64_t>(i), base::Stream("bowl noise"));
    const auto point = strategy.Ask(1, {}).at(0).point;
    strategy.Tell({.point = point, .value = Bowl(point) + noise * random.Normal()});
  }
  return Bowl(strategy.Recommend().point);
}

TEST(RbfStrategy, FindsTheMinimumWithAndWithoutNoise) {
  const auto smooth = MakeStrategy({.kind = StrategyKind::kRbf}, {.num_parameters = 2}, nullptr, 1);
  EXPECT_LT(RunFor(*smooth, 25, 0), 1e-4);  // the best of 25 random points is near 1e-2
  const auto noisy = MakeStrategy({.kind = StrategyKind::kRbf}, {.num_parameters = 2}, nullptr, 1);
  EXPECT_LT(RunFor(*noisy, 40, 0.03), 0.02);
}

// The surrogate knows no value there, and carries the slope on.
TEST(RbfStrategy, DoesNotRecommendWhereEvaluationsFail) {
  const auto strategy =
      MakeStrategy({.kind = StrategyKind::kRbf}, {.num_parameters = 1}, nullptr, 1);
  for (int i = 0; i < 25; ++i) {
    base::Random random(static_cast<std::uint64_t>(i), base::Stream("slope noise"));
    const auto point = strategy->Ask(1, {}).at(0).point;
    const bool failed = point[0] > 0.6;
    strategy->Tell({.point = point, .failed = failed, .value = -point[0] + 0.03 * random.Normal()});
  }
  EXPECT_LT(strategy->Recommend().point[0], 0.75);  // the nearest failure seen is beyond 0.6
}

// Rounding errors of equal values were taken for a landscape, and a third of the points crowded.
TEST(RbfStrategy, WhereAllValuesAreEqualItFillsTheSpace) {
  const auto strategy =
      MakeStrategy({.kind = StrategyKind::kRbf}, {.num_parameters = 2}, nullptr, 1);
  std::vector<Eigen::VectorXd> points;
  int num_crowded = 0;
  for (int i = 0; i < 24; ++i) {
    const Eigen::VectorXd point = strategy->Ask(1, {}).at(0).point;
    // 24 points at equal distances in the square lie 0.2 apart.
    for (const Eigen::VectorXd& other : points) num_crowded += (point - other).norm() < 0.04;
    points.push_back(point);
    strategy->Tell({.point = point, .value = 0.3});
  }
  EXPECT_LE(num_crowded, 5);  // every fifth step has no term of distance, and one step is a repeat
}

TEST(RbfStrategy, ToldTheSameProposesTheSameAndBatchesDiffer) {
  const auto first = MakeStrategy({.kind = StrategyKind::kRbf}, {.num_parameters = 2}, nullptr, 1);
  const auto second = MakeStrategy({.kind = StrategyKind::kRbf}, {.num_parameters = 2}, nullptr, 1);
  for (int i = 0; i < 12; ++i) {
    const auto point = first->Ask(1, {}).at(0).point;
    for (Strategy* strategy : {first.get(), second.get()}) {
      strategy->Tell({.point = point, .value = Bowl(point)});
    }
  }
  const auto batch = first->Ask(4, {});
  const auto again = second->Ask(4, {});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    EXPECT_EQ(batch[i].point, again[i].point);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(surrogate::SamePoint(batch[i].point, batch[j].point));
  }
}

}  // namespace rbf_strategy_test
}  // namespace talus::optimizer
