#include "base/student_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/sample.h"

namespace talus::base {
namespace student_factor_test {

// One degree of freedom is Cauchy's: t = tan(πp/2). Two have t = p √(2 / (1 - p²)). The other
// values are the tables', to their last digit.
TEST(StudentFactor, IsWhatTheTablesHave) {
  for (const double share : {0.5, 0.9, 0.99}) {
    EXPECT_NEAR(StudentFactor(1, share) / std::tan(std::numbers::pi / 2 * share), 1, 1e-6);
    EXPECT_NEAR(StudentFactor(2, share), share * std::sqrt(2 / (1 - share * share)), 1e-5);
  }
  EXPECT_NEAR(StudentFactor(4, 0.99), 4.604, 1e-3);
  EXPECT_NEAR(StudentFactor(10, 0.9), 1.812, 1e-3);
  EXPECT_NEAR(StudentFactor(30, 0.99), 2.750, 1e-3);
  EXPECT_NEAR(StudentFactor(std::numeric_limits<double>::infinity(), 0.99), 2.576, 1e-3);
}

TEST(StudentShare, IsTheInverse) {
  for (const double degrees : {1.0, 4.0, 30.0, std::numeric_limits<double>::infinity()}) {
    for (const double share : {0.1, 0.9, 0.999}) {
      EXPECT_NEAR(StudentShare(degrees, StudentFactor(degrees, share)), share, 1e-9);
    }
    EXPECT_EQ(StudentShare(degrees, 0), 0);
  }
}

// t(0.9) of tables over 1.645.
TEST(NormalError, IsWiderByFewValues) {
  EXPECT_EQ(NormalError(2, 0), 2);
  EXPECT_NEAR(NormalError(2, 1), 2 * 6.314 / 1.645, 0.01);
  EXPECT_NEAR(NormalError(2, 2), 2 * 2.920 / 1.645, 0.01);
}

TEST(PooledScatter, IsThatWithinGroupsWhateverTheirMeans) {
  PooledScatter scatter;
  EXPECT_TRUE(std::isnan(scatter.StandardError(3)));
  scatter.Add(SampleOf({5}));          // says nothing of scatter
  scatter.Add(SampleOf({1, 3}));       // squares 2
  scatter.Add(SampleOf({10, 11, 9}));  // squares 2
  EXPECT_EQ(scatter.degrees, 3);
  EXPECT_DOUBLE_EQ(scatter.StandardError(3), std::sqrt(4.0 / 3 / 3));
}

}  // namespace student_factor_test
}  // namespace talus::base
