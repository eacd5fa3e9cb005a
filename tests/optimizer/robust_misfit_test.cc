#include "optimizer/posterior/robust_misfit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::optimizer {
namespace robust_misfit_test {

double Rho(double squared, Eigen::Index k) {
  return RobustMisfit(Eigen::ArrayXd::Constant(1, squared), k)[0];
}

TEST(RobustMisfit, IsTheMisfitItselfWhereResidualsAreAsExpected) {
  for (const double m : {0.0, 0.5, 5.0, 10.0}) EXPECT_EQ(Rho(m, 10), m);
}

TEST(RobustMisfit, GoesOnWithoutAStepAndEverMoreSlowly) {
  EXPECT_NEAR(Rho(10.001, 10), Rho(10, 10) + 0.001, 1e-6);
  EXPECT_LT(Rho(40, 10) - Rho(30, 10), 10 * 18.0 / 38);
  EXPECT_GT(Rho(40, 10), Rho(30, 10));
  // That of a Student-t of 8 degrees of freedom, whose density falls as M^-9 for 10 outputs.
  EXPECT_NEAR(Rho(2e6, 10) - Rho(1e6, 10), 18 * std::log(2.0), 1e-3);
}

// Quantiles of χ²: 2.71 for one output and 15.99 for ten. Those of a Student-t, K F(K, 8): 3.46
// and 25.4, from tables; the same tail on a Gaussian middle lies a few percent beyond.
TEST(RobustMisfit, QuantilesAreThoseOfAHeavyTail) {
  EXPECT_GT(RobustQuantile(1, 0.9), 2.71);
  EXPECT_NEAR(RobustQuantile(1, 0.9), 3.46, 0.1 * 3.46);
  EXPECT_GT(RobustQuantile(10, 0.9), 15.99);
  EXPECT_NEAR(RobustQuantile(10, 0.9), 25.4, 0.1 * 25.4);
  EXPECT_LT(RobustQuantile(10, 0.5), RobustQuantile(10, 0.9));
}

}  // namespace robust_misfit_test
}  // namespace talus::optimizer
