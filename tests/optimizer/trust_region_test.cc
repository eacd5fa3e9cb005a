#include "optimizer/search/trust_region.h"

#include <gtest/gtest.h>

#include "optimizer/designs/r_sequence.h"

namespace talus::optimizer {
namespace trust_region_test {

double Quadratic(const Eigen::VectorXd& x) {
  const Eigen::VectorXd away = x - Eigen::Vector3d(0.42, 0.5, 0.61);
  return 3 * away[0] * away[0] + away[1] * away[1] + 2 * away[2] * away[2] + away[0] * away[1];
}

History Sampled(int count, double reach) {
  History history{.points = RSequence(count, 3, 1), .values = Eigen::VectorXd(count), .failed = {}};
  history.points = (0.5 + reach * (history.points.array() - 0.5)).matrix();
  for (int i = 0; i < count; ++i) history.values[i] = Quadratic(history.points.row(i));
  return history;
}

// Twenty points determine the ten terms; the slight ridge moves the minimum by less than 1e-3.
TEST(TrustRegion, StepsToTheMinimumOfAQuadratic) {
  const auto step = TrustRegionStep(Sampled(20, 0.5), {.num_parameters = 3});
  ASSERT_TRUE(step);
  EXPECT_LT((*step - Eigen::Vector3d(0.42, 0.5, 0.61)).norm(), 1e-3);
}

TEST(TrustRegion, StaysWithinTheNeighboursReachAndTheCube) {
  History history = Sampled(20, 0.1);
  history.values = history.points.col(0);  // falls to the left for ever
  const auto step = TrustRegionStep(history, {.num_parameters = 3});
  ASSERT_TRUE(step);
  EXPECT_LT((*step)[0], history.points.col(0).minCoeff());
  EXPECT_GT((*step)[0], history.points.col(0).minCoeff() - 0.15);
  history.points.col(0).array() -= history.points.col(0).minCoeff() - 0.01;
  history.values = history.points.col(0);
  const auto at_wall = TrustRegionStep(history, {.num_parameters = 3});
  ASSERT_TRUE(at_wall);
  EXPECT_EQ((*at_wall)[0], 0);
}

TEST(TrustRegion, SaysNothingFromTooFewPoints) {
  EXPECT_FALSE(TrustRegionStep(Sampled(4, 0.5), {.num_parameters = 3}));
}

}  // namespace trust_region_test
}  // namespace talus::optimizer
