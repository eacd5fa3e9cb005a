#include "base/line_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::base {
namespace {

TEST(LineFit, PointsOfALineGiveItBack) {
  LineFit fit;
  for (const double x : {-1.0, 0.5, 2.0, 7.0}) fit.Add(x, 3 - 0.25 * x);
  EXPECT_EQ(fit.Count(), 4);
  EXPECT_NEAR(fit.Line().at_zero, 3, 1e-14);  // a few roundings of numbers below ten
  EXPECT_NEAR(fit.Line().slope, -0.25, 1e-15);
  EXPECT_NEAR(fit.Line().At(100), -22, 1e-12);
  EXPECT_NEAR(fit.Squares(), 0, 1e-14);
}

TEST(LineFit, LeavesTheLeastSquares) {
  // (0, 0), (1, 1), (2, 0): the mean is the best line, 1/9 + 4/9 + 1/9 off.
  LineFit fit;
  fit.Add(0, 0);
  fit.Add(1, 1);
  fit.Add(2, 0);
  EXPECT_NEAR(fit.Slope(), 0, 1e-15);
  EXPECT_NEAR(fit.Line().at_zero, 1.0 / 3, 1e-15);
  EXPECT_NEAR(fit.Squares(), 2.0 / 3, 1e-15);
  EXPECT_NEAR(fit.Rms(), std::sqrt(2.0 / 9), 1e-15);
  EXPECT_NEAR(fit.At(3, 1), 1.0 / 3 + 2, 1e-15);  // of slope 1, through (1, 1/3)
}

TEST(LineFit, FarFromZeroLosesNoDigits) {
  // Sums of squares would: 1e18 holds no 1 beside it.
  LineFit fit;
  for (int i = 0; i < 10; ++i) fit.Add(1e9 + i, 2.0 * i);
  EXPECT_NEAR(fit.Slope(), 2, 1e-6);  // the means are rounded to 1e-7
}

TEST(LineFit, PointsAboveOneAnotherDetermineNone) {
  LineFit fit;
  EXPECT_FALSE(fit.IsDetermined());
  fit.Add(2, 1);
  fit.Add(2, 5);
  EXPECT_FALSE(fit.IsDetermined());
  EXPECT_TRUE(std::isnan(fit.Slope()));
  fit.Add(3, 3);
  EXPECT_TRUE(fit.IsDetermined());
}

}  // namespace
}  // namespace talus::base
