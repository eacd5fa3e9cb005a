#include "optimizer/search/local_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/designs/r_sequence.h"
#include "optimizer/search/neighbours.h"

namespace talus::optimizer {
namespace local_step_test {

const Eigen::Vector3d kBottom(0.42, 0.5, 0.61);
const Domain kCube{.num_parameters = 3};

double CurvedValley(const Eigen::VectorXd& x) {
  const Eigen::VectorXd z = 1 + 3 * (x - kBottom).array();
  return 100 * std::pow(z[0] * z[0] - z[1], 2) + std::pow(z[0] - 1, 2) +
         10 * std::pow(z[1] - z[2], 2);
}
double Cone(const Eigen::VectorXd& x) {
  const Eigen::Vector3d away = x - kBottom;
  return std::sqrt(away.squaredNorm() + 3 * away[0] * away[0]);
}

template <class Objective>
History Sampled(const Objective& objective, int count, double reach) {
  History history{.points = RSequence(count, 3, 1), .values = Eigen::VectorXd(count), .failed = {}};
  history.points = (0.5 + reach * (history.points.array() - 0.5)).matrix();
  for (int i = 0; i < count; ++i) history.values[i] = objective(history.points.row(i));
  return history;
}

template <class Objective>
double BestAfter(const Objective& objective, History history, int num_steps) {
  for (int i = 0; i < num_steps; ++i) {
    const auto step = LocalStep(history, kCube, {}, static_cast<std::uint64_t>(i));
    EXPECT_TRUE(step);
    if (!step) break;
    const auto last = history.values.size();
    history.points.conservativeResize(last + 1, Eigen::NoChange);
    history.points.row(last) = *step;
    history.values.conservativeResize(last + 1);
    history.values[last] = objective(*step);
  }
  return history.values.minCoeff();
}

// 0.03 is a ten thousandth of the function's spread over the cube; the best of the 20 first points
// is above 10.
TEST(LocalStep, FollowsACurvedValley) {
  EXPECT_LT(BestAfter(CurvedValley, Sampled(CurvedValley, 20, 1), 30), 0.03);
}

// The first points come no nearer than 0.1. Not squared, the cone is missed by more than 1e-3.
TEST(LocalStep, FindsTheTipOfACone) { EXPECT_LT(BestAfter(Cone, Sampled(Cone, 20, 1), 15), 1e-4); }

TEST(LocalStep, StaysWithinTheReachOfTheNeighboursAndTheDomain) {
  History history = Sampled(CurvedValley, 20, 0.1);
  history.values = history.points.col(0);  // falls to the left for ever
  const Neighbours near = NeighboursOfBest(history, 20);
  const auto step = LocalStep(history, kCube, {}, 1);
  ASSERT_TRUE(step);
  EXPECT_LT((*step)[0], near.middle[0]);
  EXPECT_LE((*step - near.middle).lpNorm<Eigen::Infinity>(), near.DistanceOf(5) * (1 + 1e-12));

  const Domain right{.num_parameters = 3,
                     .feasible = [&](const Eigen::VectorXd& x) { return x[0] >= near.middle[0]; }};
  const auto inside = LocalStep(history, right, {}, 1);
  ASSERT_TRUE(inside);
  EXPECT_TRUE(right.Contains(*inside));
}

// With the prediction at the first step fantasised, the next one has more to find elsewhere; were
// the incumbent still the best evaluation, it would at times land within a hundredth of the reach.
TEST(LocalStep, KeepsAwayFromPendingPoints) {
  for (int count = 12; count < 30; ++count) {
    const History history = Sampled(CurvedValley, count, 0.4);
    const auto first = LocalStep(history, kCube, {}, 1);
    ASSERT_TRUE(first);
    const auto second = LocalStep(history, kCube, {{*first}}, 1);
    ASSERT_TRUE(second);
    const double reach = NeighboursOfBest(history, count).DistanceOf(5);
    EXPECT_GT((*second - *first).norm(), 0.05 * reach) << count;
  }
}

TEST(LocalStep, SaysNothingFromTooFewPoints) {
  EXPECT_FALSE(LocalStep(Sampled(Cone, 4, 0.5), kCube, {}, 1));
}

TEST(Neighbours, AreTheNearestInOrderWithoutRepeatsOfTheBest) {
  History history{.points = Eigen::MatrixXd(5, 1), .values = Eigen::VectorXd(5), .failed = {}};
  history.points << 0.9, 0.5, 0.5, 0.6, 0.1;
  history.values << 3, 1, 1, 2, 4;
  const Neighbours near = NeighboursOfBest(history, 2);
  EXPECT_EQ(near.best, 1);
  EXPECT_EQ(near.middle[0], 0.5);
  EXPECT_EQ(near.others, (std::vector<Eigen::Index>{3, 0}));
  EXPECT_DOUBLE_EQ(near.DistanceOf(0), 0.1);
  EXPECT_DOUBLE_EQ(near.DistanceOf(7), 0.4);
}

}  // namespace local_step_test
}  // namespace talus::optimizer
