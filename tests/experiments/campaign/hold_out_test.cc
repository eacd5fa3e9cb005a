#include "experiments/campaign/answer/hold_out.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "experiments/analysis/card/card.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/report/views/answer_words.h"
#include "experiments/campaign/answer/agreement.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/status.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/two_experiments.h"

namespace talus::campaign {
namespace hold_out_test {

using ::testing::HasSubstr;

class HoldingOut : public TwoExperiments {};

TEST_F(HoldingOut, TheOthersPredictOneThatIsHeldOut) {
  const auto folder = Finished("run", "23 mg", 40);
  const JointView view = ReadJointView(folder);
  const HeldOut fast = HoldOut(view, "fast lift");
  EXPECT_EQ(fast.others.experiments, std::vector<std::string>{"heap"});
  EXPECT_LT(fast.others.low[0], kTrueSliding);
  EXPECT_GT(fast.others.high[0], kTrueSliding);
  ASSERT_EQ(fast.predicted.numbers.size(), 1u);
  EXPECT_TRUE(fast.predicted.numbers[0].IsInside())
      << fast.predicted.numbers[0].low << " " << fast.predicted.numbers[0].high;
  EXPECT_LT(fast.predicted.least_implausibility, 2);
  EXPECT_LE(fast.predicted.least_implausibility, fast.predicted.implausibility);
  EXPECT_THAT(HeldOutText(view, fast), HasSubstr("mass fallen"));
  EXPECT_THAT(HeldOutJson(view, fast), HasSubstr("\"least_implausibility\""));
}

// 42 mg would fall at μ_t 0.13, which the heaps exclude.
TEST_F(HoldingOut, OneThatDisagreesIsNoticedAndEachSaysWhatItAnswersAlone) {
  const auto folder = Begin("run", "42 mg", 40);
  RunFake(folder, {});
  const JointView view = ReadJointView(folder);
  EXPECT_FALSE(HoldOut(view, "fast lift").predicted.numbers.at(0).IsInside())
      << HeldOutText(view, HoldOut(view, "fast lift")) << base::ReadFile(folder / "result.json");
  const Answer result = ParseAnswer(base::ReadFile(folder / "result.json"));
  ASSERT_EQ(result.posterior.value().alone.size(), 2u);
  EXPECT_EQ(result.posterior->alone[0].name, "heap");
  // The runs went to where both are least wrong, so the heap's own answer is a coarse one.
  EXPECT_NEAR(result.posterior->alone[0].values[0], kTrueSliding, 0.15);
  EXPECT_THAT(AnswerSummary(result, "runs/heap"), HasSubstr("no set fits"));
  EXPECT_THAT(AnswerSummary(result, "runs/heap"), HasSubstr("heap alone"));
  EXPECT_GT(result.posterior->tension, 2);
  EXPECT_TRUE(std::ranges::any_of(result.warnings, [](const Alarm& w) {
    return w.kind == AlarmKind::kDisagree && !w.experiment.value_or("").empty();
  }));
}

TEST_F(HoldingOut, TestsThatAgreeRaiseNoAlarm) {
  const auto folder = Finished("run", "23 mg", 40);
  const Answer result = ParseAnswer(base::ReadFile(folder / "result.json"));
  EXPECT_TRUE(result.posterior.value().alone.empty()) << AnswerSummary(result, "runs/heap");
  EXPECT_LT(result.posterior->tension, 2);
  EXPECT_EQ(AnswerSummary(result, "runs/heap").find("no set fits"), std::string::npos);
}

// By hand: of 2 degrees χ² is beyond 9.21 with probability 0.01 and beyond 13.8 with 0.001, of 1
// degree beyond 6.63 with 0.01 (tables); the cube root is within 0.06 of it there.
TEST(Agreement, TensionIsThatOfANormalVariableAsUnlikely) {
  EXPECT_NEAR(Tension(9.21, 2), 2.326, 0.06);
  EXPECT_NEAR(Tension(13.82, 2), 3.090, 0.06);
  EXPECT_NEAR(Tension(6.635, 1), 2.326, 0.06);
  EXPECT_EQ(Tension(0.5, 2), 0);  // less than usual
  EXPECT_EQ(Tension(-1, 2), 0);
  EXPECT_TRUE(std::isnan(Tension(1, 0.4)));  // a nuisance's share of a degree tells nothing
  Answer answer;
  answer.posterior.emplace().tension = Tension(1, 0.4);
  EXPECT_TRUE(std::isnan(ParseAnswer(AnswerJson(answer)).posterior->tension));
  EXPECT_GT(Tension(4, 0.6), 1);
}

TEST(Agreement, TensionIsNoAlarmWhereSurrogatesMissMostOfTheirOwnTrials) {
  EXPECT_TRUE(Disagree(2.1, 0.9));
  EXPECT_TRUE(Disagree(2.1, 0.5));
  EXPECT_FALSE(Disagree(2.1, 0.49));
  EXPECT_FALSE(Disagree(1.9, 0.9));
}

// 42 mg would drag the answer to low friction (the test above); held out, it does not.
TEST_F(HoldingOut, ACampaignAnswersWithoutOneThatIsHeldOutAndPredictsIt) {
  const auto folder = Begin("run", "42 mg", 30, {.hold_out = "fast lift"});
  RunFake(folder, {});
  const Answer result = ParseAnswer(base::ReadFile(folder / "result.json"));
  EXPECT_LT(result.parameters[0].credible_low, kTrueSliding);
  EXPECT_GT(result.parameters[0].credible_high, kTrueSliding);
  EXPECT_GT(result.parameters[0].credible_low, 0.2);
  ASSERT_EQ(result.posterior.value().experiments.size(), 1u);
  EXPECT_EQ(result.posterior->experiments[0].name, "heap");
  ASSERT_EQ(result.conditions.devices.size(), 1u);  // it holds for what it is made from
  EXPECT_EQ(result.conditions.devices[0].experiment, "heap");
  const ResultHeldOut& held_out = result.held_out.value();
  EXPECT_EQ(held_out.name, "fast lift");
  ASSERT_EQ(held_out.numbers.size(), 1u);
  const PredictedNumber& fallen = held_out.numbers[0];
  EXPECT_NEAR(fallen.mean, 23e-6, 6e-6);  // what falls at the truth; the heaps leave ±0.1 of μ_t
  EXPECT_GT(fallen.sd, 0);
  EXPECT_EQ(fallen.measured, 42e-6);
  EXPECT_FALSE(fallen.IsInside());
  EXPECT_GT(held_out.implausibility, 3);
  EXPECT_THAT(AnswerSummary(result, "runs/heap"),
              HasSubstr("fast lift, which the answer is made without"));
  const analysis::Card card = analysis::ReadCard(folder);
  ASSERT_EQ(card.tests.size(), 1u);
  EXPECT_EQ(card.tests[0].name, "heap");
  EXPECT_EQ(AnswerSummary(result, "runs/heap").find("no set fits"), std::string::npos);
  const analysis::Evidence evidence = analysis::GatherEvidence(folder, "");
  EXPECT_THAT(analysis::HeldOutWords(evidence.answer.value()).front(),
              HasSubstr("without fast lift"));
  // It is simulated where the others are, by design and to confirm, but nowhere for its own sake.
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  for (const journal::TrialRecord& trial : journal.Trials()) {
    EXPECT_FALSE(trial.experiment == 1 && trial.kind == journal::TrialKind::kSearch);
  }
  const std::string considered = ConsideredText(
      ConsiderSet(folder, {{"sliding_friction", "0.45"}, {"rolling_friction", "0.2"}}));
  EXPECT_THAT(considered, HasSubstr("heap: predicted"));
  EXPECT_EQ(considered.find("fast lift:"), std::string::npos);  // but for trials near the set
}

// It was asked for its design again and again, and the budget ended without an answer.
TEST_F(HoldingOut, ATestWhoseTrialsAllFailEndsTheSearchUntilItIsMended) {
  const auto folder = Begin("failing", "23 mg", 40, {.hold_out = "fast lift"});
  RunFake(folder, {.fail_fast = true});
  EXPECT_FALSE(std::filesystem::exists(folder / "result.json"));
  const std::string status = StatusText(folder);
  EXPECT_THAT(status, HasSubstr("the first 8 trials of \"fast lift\" all failed"));
  EXPECT_THAT(status, HasSubstr("ended without a result; mend the cause, and `talus resume"));
  RunFake(folder, {});
  for (const auto& trial : journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Trials()) {
    EXPECT_EQ(trial.status, journal::TrialStatus::kOk);
  }
  const Answer answer = ParseAnswer(base::ReadFile(folder / "result.json"));
  EXPECT_NE(answer.stop.kind, StopKind::kAllFailed);
  EXPECT_FALSE(answer.held_out.value().numbers.empty());
}

TEST_F(HoldingOut, WhatCannotBeHeldOutIsSaid) {
  for (const char* name : {"slow lift", ""}) {
    try {
      Begin("refused", "23 mg", 20, {.hold_out = name});
      ADD_FAILURE() << "held \"" << name << "\" out";
    } catch (const base::ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("is no experiment; there are \"heap\", \"fast lift\""));
    }
  }
}

// It went on being held out, and the change was said to be one that may be made.
TEST_F(HoldingOut, ASpecThatHoldsItOutNoLongerIsAnotherCampaign) {
  const auto first = Begin("first");
  const auto in = scratch_.path() / "first_in" / "spec.json";
  const std::string without = base::ReadFile(in);
  std::string with = without;
  with.insert(with.find("\"budget\""), "\"hold_out\": \"fast lift\", ");
  std::ofstream(in) << with;
  const auto folder = scratch_.path() / "held";
  BeginCampaign(in, folder);
  std::ofstream(in) << without;
  EXPECT_THAT(ErrorIn([&] { RunFake(folder, {}); }), HasSubstr("hold_out"));
}

using HoldingOneOut = CampaignFixture;

TEST_F(HoldingOneOut, ACampaignWithOneExperimentHasNothingToHoldOut) {
  const auto folder = Begin(R"(, "budget": {"simulations": 8}, "workers": 1)");
  RunFake(folder, {});
  const JointView view = ReadJointView(folder);
  EXPECT_THROW(HoldOut(view, "heap"), base::ConfigError);
  EXPECT_THROW(HoldOut(view, "slow lift"), base::ConfigError);
}

}  // namespace hold_out_test
}  // namespace talus::campaign
