// When a search ends by itself, at the edge of each rule.
#include "optimizer/search/stopping_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace talus::optimizer {
namespace stopping_rule_test {

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

TEST(StoppingRule, CalibrationsEndWhereNoNumberOfTrialsWouldNarrowARange) {
  const auto reason = StopByOutlook({.all = {0.02, 0.049}, .temper = 1.1}, 0.05);
  ASSERT_TRUE(reason);
  EXPECT_EQ(reason->rule, StopRule::kShare);
  EXPECT_DOUBLE_EQ(reason->value, 0.049);
  EXPECT_THAT(TextOf(*reason), HasSubstr("by more than 4.9 %"));
  EXPECT_THAT(TextOf(StopReason{.rule = StopRule::kShare, .value = 4e-5, .limit = 0.1}),
              HasSubstr("no number of them any range by as much as 0.01 %, and 10 %"));
  EXPECT_FALSE(StopByOutlook({.all = {0.051, 0.02}, .temper = 1.1}, 0.05));
  EXPECT_FALSE(StopByOutlook({.all = {0.028}, .temper = 2.9},
                             0.05));  // an early model that misses a third of its trials
  EXPECT_FALSE(StopByOutlook({.all = {kNan}}, 0.05));
  EXPECT_FALSE(StopByOutlook({}, 0.05));
}

TEST(StoppingRule, WhatHalfAsManyTrialsAgainWouldNarrowIsSaidFromTheShareOn) {
  const std::vector<std::string> names{"sliding_friction", "rolling_friction"};
  const auto shortfall = ShortOfOutlook({.again = {0.07, 0.15}, .all = {0.2, 0.4}}, 0.1, 41);
  ASSERT_TRUE(shortfall);
  EXPECT_EQ(shortfall->lack, StopLack::kShare);
  EXPECT_EQ(shortfall->num_more, 21);
  EXPECT_EQ(TextOf(*shortfall, names),
            "21 more simulations are expected to narrow the ranges: rolling_friction by 15 %");
  EXPECT_FALSE(ShortOfOutlook({.again = {0.07, 0.09}, .all = {0.2, 0.4}}, 0.1, 41));
  const auto unsure = ShortOfOutlook({.again = {0.01, 0.01}, .temper = 4}, 0.1, 40);
  ASSERT_TRUE(unsure);
  EXPECT_THAT(TextOf(*unsure, names), testing::StartsWith("trials left out are missed by 2 times"));
}

}  // namespace stopping_rule_test
}  // namespace talus::optimizer
