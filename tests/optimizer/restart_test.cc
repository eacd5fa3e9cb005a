#include "optimizer/search/restart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/designs/r_sequence.h"
#include "optimizer/strategy/scalar_strategy.h"

namespace talus::optimizer {
namespace restart_test {

constexpr int kNumBefore = 20;
const Eigen::Vector2d kDeep(0.2, 0.2);
const Eigen::Vector2d kShallow(0.8, 0.7);

// Two bowls, the one at kDeep lower.
double TwoBowls(const Eigen::VectorXd& x) {
  return std::min((x - kDeep).squaredNorm(), 0.05 + (x - kShallow).squaredNorm());
}

// An even sample, then `num_polishing` points at steps of 1e-3 away from kDeep.
History Polished(int num_polishing) {
  const Eigen::MatrixXd even = RSequence(kNumBefore, 2, 1);
  History history{.points = Eigen::MatrixXd(kNumBefore + num_polishing, 2),
                  .values = Eigen::VectorXd(kNumBefore + num_polishing),
                  .failed = {}};
  history.points.topRows(kNumBefore) = even;
  for (int i = 0; i < num_polishing; ++i) {
    history.points.row(kNumBefore + i) = kDeep + Eigen::Vector2d(1e-3 * i, 0);
  }
  for (Eigen::Index i = 0; i < history.values.size(); ++i) {
    history.values[i] = TwoBowls(history.points.row(i));
  }
  return history;
}

TEST(Restart, LeavesASearchAloneThatGetsOn) {
  EXPECT_FALSE(RestartElsewhere(Polished(0), {.num_parameters = 2}, kNumBefore));
  EXPECT_FALSE(RestartElsewhere(Polished(4), {.num_parameters = 2}, kNumBefore));
  History gaining = Polished(9);
  gaining.values[kNumBefore + 8] = -0.1;
  EXPECT_FALSE(RestartElsewhere(gaining, {.num_parameters = 2}, kNumBefore));
}

TEST(Restart, TurnsToTheOtherBasinWhenOneIsPolished) {
  const auto elsewhere = RestartElsewhere(Polished(9), {.num_parameters = 2}, kNumBefore);
  ASSERT_TRUE(elsewhere);
  EXPECT_FALSE(elsewhere->domain.Contains(kDeep));
  EXPECT_FALSE(elsewhere->domain.Contains(kDeep + Eigen::Vector2d(0.02, 0.03)));
  EXPECT_TRUE(elsewhere->domain.Contains(kShallow));
  Eigen::Index best = 0;
  elsewhere->history.values.minCoeff(&best);
  // Twenty even points are 0.2 apart.
  EXPECT_LT((elsewhere->history.points.row(best).transpose() - kShallow).norm(), 0.2);
}

TEST(Restart, KeepsToWhatTheDomainAllows) {
  const Domain left{.num_parameters = 2, .feasible = [](const auto& x) { return x[0] < 0.5; }};
  const auto elsewhere = RestartElsewhere(Polished(9), left, kNumBefore);
  ASSERT_TRUE(elsewhere);
  EXPECT_FALSE(elsewhere->domain.Contains(kShallow));
}

// Rosenbrock's function of three parameters with its minimum, 0, in the cube, and a lowest point of
// another valley, 2.68, on its boundary. Without restarts every step from 43 to 100 polishes that.
double TwoValleys(const Eigen::VectorXd& x) {
  const Eigen::Vector3d z(1 - 3 * (x[0] - 0.358386), 1 + 3 * (x[1] - 0.272035),
                          1 + 3 * (x[2] - 0.744589));
  return 100 * std::pow(z[0] * z[0] - z[1], 2) + std::pow(z[0] - 1, 2) +
         100 * std::pow(z[1] * z[1] - z[2], 2) + std::pow(z[1] - 1, 2);
}

TEST(Restart, FindsTheDeeperValleyOfAFunctionWithoutNoise) {
  ScalarStrategy strategy({.num_parameters = 3}, {.stop_multiple = 0, .seed = 7308});
  double lowest = INFINITY;
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd point = strategy.Ask(1, {}).at(0).point;
    const double value = TwoValleys(point);
    lowest = std::min(lowest, value);
    strategy.Tell({.point = point, .value = value});
  }
  EXPECT_LT(lowest, 0.1);
}

}  // namespace restart_test
}  // namespace talus::optimizer
