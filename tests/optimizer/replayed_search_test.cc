#include "optimizer/strategy/replayed_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimizer/search/history.h"
#include "optimizer/strategy/make_strategy.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace replayed_search_test {

using ::testing::HasSubstr;

double Bowl(const Eigen::VectorXd& u) {
  return (u - Eigen::Vector3d(0.3, 0.6, 0.45)).cwiseProduct(Eigen::Vector3d(1, 2, 3)).squaredNorm();
}

std::unique_ptr<Strategy> Make(StrategyKind kind) {
  return MakeStrategy({.kind = kind}, Domain{.num_parameters = 3}, nullptr, 7);
}

class EverySearch : public testing::TestWithParam<StrategyKind> {};

TEST_P(EverySearch, ToldTheSameGoesOnTheSame) {
  const auto first = Make(GetParam());
  const auto second = Make(GetParam());
  for (int i = 0; i < 30; ++i) {
    const auto proposals = first->Ask(1, {});
    ASSERT_EQ(proposals.size(), 1u);
    const Observation observation{.point = proposals[0].point, .value = Bowl(proposals[0].point)};
    first->Tell(observation);
    second->Tell(observation);
  }
  EXPECT_EQ(first->Ask(1, {})[0].point, second->Ask(1, {})[0].point);
}

// BOBYQA shifts a start that is near a bound, DIRECT has none.
TEST_P(EverySearch, TriesAGuessFirst) {
  const Eigen::VectorXd guess = Eigen::Vector3d(0.05, 0.5, 0.98);
  const auto strategy = MakeStrategy({.kind = GetParam()},
                                     Domain{.num_parameters = 3, .guesses = {guess}}, nullptr, 7);
  EXPECT_EQ(strategy->Ask(1, {}).at(0).point, guess);
}

TEST_P(EverySearch, BatchesHoldNoPointTwiceAndNoPendingOne) {
  const auto strategy = Make(GetParam());
  std::vector<Eigen::VectorXd> asked;
  for (int i = 0; i < 10; ++i) {
    const auto before = strategy->Ask(2, {});
    const std::vector<Eigen::VectorXd> pending{before[0].point, before[1].point};
    auto proposals = strategy->Ask(2, pending);
    proposals.insert(proposals.begin(), before.begin(), before.end());
    for (const Proposal& p : proposals) {
      for (const auto& other : asked) ASSERT_FALSE(surrogate::SamePoint(p.point, other));
      asked.push_back(p.point);
      ASSERT_TRUE((p.point.array() >= 0).all() && (p.point.array() <= 1).all());
    }
    for (const Proposal& p : proposals) strategy->Tell({.point = p.point, .value = Bowl(p.point)});
  }
}

TEST_P(EverySearch, GetsNearerThanChance) {
  const auto strategy = Make(GetParam());
  for (int i = 0; i < 200; ++i) {
    const Proposal p = strategy->Ask(1, {}).at(0);
    // A failed run in the way must not stop the search.
    strategy->Tell({.point = p.point, .failed = i == 20, .value = Bowl(p.point)});
  }
  const Answer answer = strategy->Recommend();
  EXPECT_EQ(answer.predicted_value, Bowl(answer.point));
  // The best of 200 random points is above 0.016 in the median: 4/3 π r³ / √6 = ln 2 / 200.
  EXPECT_LT(answer.predicted_value, 0.016);
}

INSTANTIATE_TEST_SUITE_P(All, EverySearch,
                         testing::Values(StrategyKind::kDirectL, StrategyKind::kBobyqa,
                                         StrategyKind::kNelderMead));

// The first evaluation fails. It counted as 0, the best ever of an objective above 5, and the
// search stayed beside it.
TEST_P(EverySearch, LeavesAFirstPointThatFails) {
  const auto strategy = Make(GetParam());
  double best = 1e300;
  for (int i = 0; i < 80; ++i) {
    const Eigen::VectorXd point = strategy->Ask(1, {}).at(0).point;
    const bool fails = (point.array() - 0.5).abs().maxCoeff() < 0.05;
    strategy->Tell({.point = point, .failed = fails, .value = 5 + Bowl(point)});
    if (!fails) best = std::min(best, Bowl(point));
  }
  EXPECT_LT(best, 0.01);
}

TEST(ReplayedSearch, IsTheSearchItself) {
  std::vector<Eigen::VectorXd> direct;
  const surrogate::SearchTask task{
      .algorithm = surrogate::SearchAlgorithm::kDirectL,
      .lower = Eigen::VectorXd::Zero(3),
      .upper = Eigen::VectorXd::Ones(3),
      .start = Eigen::VectorXd::Constant(3, 0.5),
      .max_evaluations = 60,
  };
  surrogate::Minimize(
      [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
        direct.push_back(x);
        return Bowl(x);
      },
      task);
  ReplayedSearch search(Domain{.num_parameters = 3, .guesses = {task.start}},
                        {.algorithm = surrogate::SearchAlgorithm::kDirectL, .name = "DIRECT-L"}, 7);
  for (std::size_t i = 0; i < direct.size(); ++i) {
    const auto point = search.Ask(1, {}).at(0).point;
    EXPECT_EQ(point, direct[i]) << i;
    search.Tell({.point = point, .value = Bowl(point)});
  }
}

TEST(ReplayedSearch, LocalSearchThatHasConvergedStartsElsewhere) {
  const auto strategy = Make(StrategyKind::kBobyqa);
  double farthest_late = 0;
  for (int i = 0; i < 200; ++i) {
    const auto point = strategy->Ask(1, {}).at(0).point;
    if (i >= 60) farthest_late = std::max(farthest_late, Bowl(point));
    strategy->Tell({.point = point, .value = Bowl(point)});
  }
  EXPECT_LT(strategy->Recommend().predicted_value, 1e-6);
  EXPECT_GT(farthest_late, 0.1);  // a new start, far from the minimum that is found by then
  EXPECT_FALSE(strategy->WhyStop());
}

TEST(ReplayedSearch, NeverAsksForAForbiddenPoint) {
  Domain domain{.num_parameters = 3};
  domain.feasible = [](const Eigen::VectorXd& u) { return u.sum() < 1; };
  for (const StrategyKind kind : {StrategyKind::kDirectL, StrategyKind::kBobyqa}) {
    const auto strategy = MakeStrategy({.kind = kind}, domain, nullptr, 7);
    for (int i = 0; i < 30; ++i) {
      const auto point = strategy->Ask(1, {}).at(0).point;
      ASSERT_LT(point.sum(), 1);
      strategy->Tell({.point = point, .value = Bowl(point)});
    }
  }
}

// In a corner that no search comes near by itself: each begins with a point of it, and asks for
// none outside. DIRECT-L went on for minutes without asking for anything, and ends after its first
// now.
TEST(ReplayedSearch, FindsADomainThatIsSmall) {
  Domain domain{.num_parameters = 3};
  domain.feasible = [](const Eigen::VectorXd& u) { return u.sum() <= 0.1; };
  for (const StrategyKind kind :
       {StrategyKind::kDirectL, StrategyKind::kBobyqa, StrategyKind::kNelderMead}) {
    const auto strategy = MakeStrategy({.kind = kind}, domain, nullptr, 7);
    for (int i = 0; i < 5; ++i) {
      const std::vector<Proposal> asked = strategy->Ask(1, {});
      if (asked.empty() && i > 0 && kind == StrategyKind::kDirectL) break;
      ASSERT_EQ(asked.size(), 1u);
      ASSERT_TRUE(domain.Contains(asked[0].point));
      strategy->Tell({.point = asked[0].point, .value = Bowl(asked[0].point)});
    }
    EXPECT_TRUE(domain.Contains(strategy->Recommend().point));
  }
}

TEST(BestObserved, WithoutAnyItIsAPointOfTheDomain) {
  Domain domain{.num_parameters = 2};
  domain.feasible = [](const Eigen::VectorXd& u) { return u.sum() <= 0.02; };
  EXPECT_TRUE(domain.Contains(BestObserved({}, domain, "none").point));
}

}  // namespace replayed_search_test
}  // namespace talus::optimizer
