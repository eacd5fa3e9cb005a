#include "experiments/analysis/sensitivity/fixed_point.h"

#include <gtest/gtest.h>

namespace talus::analysis {
namespace fixed_point_test {

Eigen::VectorXd Along(double x, double y) { return Eigen::Vector2d(x, y); }

// Each of these is linear along one line, where two values tell the fixed point, whatever the
// slope.
TEST(FixedPoint, OfALinearFunctionIsTheSecondEstimate) {
  for (const double slope : {-2.0, -0.9, -0.3, 0.3}) {
    const Eigen::VectorXd fixed = Along(0.4, 0.7);
    const auto function = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
      return fixed + slope * (at - fixed);
    };
    FixedPoint search(Along(0.1, 0.02));
    const Eigen::VectorXd first = Along(0.5, 0.6);
    const Eigen::VectorXd second = search.Next(first, function(first));
    EXPECT_NEAR((second - function(first)).norm(), 0, 1e-15) << "the first value as it is";
    EXPECT_NEAR((search.Next(second, function(second)) - fixed).norm(), 0, 1e-12) << slope;
  }
}

// Two equal residuals say nothing of where they vanish.
TEST(FixedPoint, EqualResidualsLeaveTheLastValue) {
  FixedPoint search(Along(1, 1));
  search.Next(Along(0, 0), Along(0.1, 0));
  EXPECT_EQ(search.Next(Along(0.1, 0), Along(0.2, 0)), Along(0.2, 0));
}

// Residuals that are nearly the same would send it far away.
TEST(FixedPoint, NoStepGoesBeyondTheLastOne) {
  FixedPoint search(Along(1, 1));
  search.Next(Along(0, 0), Along(0.1, 0));
  const Eigen::VectorXd next = search.Next(Along(0.1, 0), Along(0.199, 0));
  EXPECT_NEAR(next[0], 0.199 + 0.099, 1e-12);
}

}  // namespace fixed_point_test
}  // namespace talus::analysis
