// When a search ends by itself, at the edge of each rule.
#include "optimizer/search/stopping_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace talus::optimizer {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(StoppingRule, NoisySearchesEndWhereTheGainIsSmallAgainstTheNoise) {
  const auto reason = StopByGain(0.0199, 0.1, 0.2);
  ASSERT_TRUE(reason);
  EXPECT_EQ(reason->rule, StopRule::kGain);
  EXPECT_THAT(TextOf(*reason), HasSubstr("below 0.2 x the noise sd"));
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
  const auto reason = StopByShare({.share = 0.049, .temper = 1.1}, 0.05);
  ASSERT_TRUE(reason);
  EXPECT_EQ(reason->rule, StopRule::kShare);
  EXPECT_THAT(TextOf(*reason), HasSubstr("4.9 % of what"));
  EXPECT_FALSE(StopByShare({.share = 0.051, .temper = 1.1}, 0.05));
  EXPECT_FALSE(StopByShare({.share = 0.028, .temper = 2.9},
                           0.05));  // an early model that misses a third of its trials
  EXPECT_FALSE(StopByShare({.share = kNan}, 0.05));
}

TEST(StoppingRule, WhatACalibrationLacksFallsAsOneOverItsEvaluations) {
  const auto shortfall = ShortOfShare({.share = 0.07, .temper = 1.2}, 0.02, 40);
  ASSERT_TRUE(shortfall);
  EXPECT_DOUBLE_EQ(shortfall->num_more, 100);  // 40 × 7/2 in all
  EXPECT_EQ(shortfall->lack, StopLack::kShare);
  EXPECT_THAT(TextOf(*shortfall), HasSubstr("7 % of what the measurements leave open"));
  EXPECT_DOUBLE_EQ(ShortOfShare({.share = 0.0671}, 0.02, 40)->num_more, 95);  // 94.2
  EXPECT_DOUBLE_EQ(ShortOfShare({.share = 0.2}, 0.02, 47)->num_more, 430);    // 423
  EXPECT_TRUE(std::isnan(ShortOfShare({.share = 0.5}, 0.02, 47)->num_more));
  EXPECT_FALSE(ShortOfShare({.share = 0.019, .temper = 1.4}, 0.02, 40));
  const auto unsure = ShortOfShare({.share = 0.01, .temper = 4}, 0.02, 40);
  ASSERT_TRUE(unsure);
  EXPECT_TRUE(std::isnan(unsure->num_more));
  EXPECT_THAT(TextOf(*unsure), HasSubstr("missed by 2 times what the model expects"));
}

}  // namespace
}  // namespace talus::optimizer
