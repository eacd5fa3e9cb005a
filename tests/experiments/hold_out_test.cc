#include "experiments/campaign/answer/hold_out.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/two_experiments.h"

namespace talus::campaign {
namespace {

using ::testing::HasSubstr;

TEST_F(TwoExperiments, TheOthersPredictOneThatIsHeldOut) {
  const auto folder = Begin("run");
  RunFake(folder, {});
  const JointView view = ReadJointView(folder);
  const HeldOut fast = HoldOut(view, "fast lift");
  EXPECT_EQ(fast.others.experiments, std::vector<std::string>{"heap"});
  EXPECT_LT(fast.others.low[0], kTrueSliding);
  EXPECT_GT(fast.others.high[0], kTrueSliding);
  ASSERT_EQ(fast.numbers.size(), 1u);
  EXPECT_TRUE(fast.numbers[0].IsInside()) << fast.numbers[0].low << " " << fast.numbers[0].high;
  EXPECT_LT(fast.least_implausibility, 2);
  EXPECT_LE(fast.least_implausibility, fast.implausibility);
  EXPECT_THAT(HeldOutText(view, fast), HasSubstr("mass_fallen_kg"));
  EXPECT_THAT(HeldOutJson(view, fast), HasSubstr("\"least_implausibility\""));
}

// 42 mg would fall at μ_t 0.13, which the heaps exclude.
TEST_F(TwoExperiments, OneThatDisagreesIsNoticedAndEachSaysWhatItAnswersAlone) {
  const auto folder = Begin("run", "42 mg", 40);
  RunFake(folder, {});
  const JointView view = ReadJointView(folder);
  EXPECT_FALSE(HoldOut(view, "fast lift").numbers.at(0).IsInside())
      << HeldOutText(view, HoldOut(view, "fast lift")) << base::ReadFile(folder / "result.json");
  const CampaignResult result = ParseResult(base::ReadFile(folder / "result.json"));
  ASSERT_EQ(result.posterior.value().alone.size(), 2u);
  EXPECT_EQ(result.posterior->alone[0].name, "heap");
  EXPECT_NEAR(result.posterior->alone[0].values[0], kTrueSliding, 0.1);
  EXPECT_THAT(ResultSummary(result), HasSubstr("no set fits"));
  EXPECT_THAT(ResultSummary(result), HasSubstr("heap alone"));
}

TEST_F(TwoExperiments, TestsThatAgreeRaiseNoAlarm) {
  const auto folder = Begin("run");
  RunFake(folder, {});
  const CampaignResult result = ParseResult(base::ReadFile(folder / "result.json"));
  EXPECT_TRUE(result.posterior.value().alone.empty()) << ResultSummary(result);
  EXPECT_EQ(ResultSummary(result).find("no set fits"), std::string::npos);
}

TEST_F(CampaignFixture, ACampaignWithOneExperimentHasNothingToHoldOut) {
  const auto folder = Begin(R"(, "budget": {"simulations": 8}, "workers": 1)");
  RunFake(folder, {});
  const JointView view = ReadJointView(folder);
  EXPECT_THROW(HoldOut(view, "heap"), base::ConfigError);
  EXPECT_THROW(HoldOut(view, "slow lift"), base::ConfigError);
}

}  // namespace
}  // namespace talus::campaign
