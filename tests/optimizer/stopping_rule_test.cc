// When a search ends by itself, at the edge of each rule.
#include "optimizer/stopping/stopping_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace talus::optimizer {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(StoppingRule, NoisySearchesEndWhereTheGainIsSmallAgainstTheNoise) {
  EXPECT_THAT(StopByGain(0.0199, 0.1, 0.2).value_or(""), HasSubstr("below 0.2 x the noise sd"));
  EXPECT_FALSE(StopByGain(0.0201, 0.1, 0.2));
  EXPECT_FALSE(StopByGain(kNan, 0.1, 0.2));
}

TEST(StoppingRule, ExactSearchesEndWhereNothingIsLeftToGain) {
  EXPECT_TRUE(StopByExactGain(1e-6, 1));
  EXPECT_TRUE(StopByExactGain(0, 0));  // all values are equal
  EXPECT_FALSE(StopByExactGain(1.1e-6, 1));
  EXPECT_FALSE(StopByExactGain(kNan, 1));
}

TEST(StoppingRule, CalibrationsEndWhereTheSurrogateKnowsEnoughAndPredictsItsTrials) {
  EXPECT_THAT(StopByShare(0.049, 1.1, 0.05).value_or(""), HasSubstr("4.9 % of what"));
  EXPECT_FALSE(StopByShare(0.051, 1.1, 0.05));
  EXPECT_FALSE(StopByShare(0.028, 2.9, 0.05));  // an early model that misses a third of its trials
  EXPECT_FALSE(StopByShare(kNan, 1, 0.05));
}

}  // namespace
}  // namespace talus::optimizer
