// Campaigns over several scale factors, with drawn heaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "experiments/analysis/export/export.h"
#include "experiments/campaign/status.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::experiments {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kTwoSizes = R"(,
  "coarse_graining": {"scale_factors": [2, 1]}, "budget": {"simulations": 16},
  "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)";

using JointCampaign = CampaignFixture;

TEST_F(JointCampaign, TrialsHaveTheScaleFactorsThatTheStrategyAsksForAndConfirmAtTheSmallest) {
  const fs::path folder = Begin(kTwoSizes);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto trials = Trials(folder);
  ASSERT_EQ(trials.size(), 16u + 2u);
  std::set<double> factors;
  for (const TrialRecord& trial : trials) {
    EXPECT_NE(trial.kind, TrialKind::kNoise);
    if (trial.kind == TrialKind::kConfirm) {
      EXPECT_EQ(trial.scale_factor, 1);
    } else {
      factors.insert(trial.scale_factor);
    }
    const HeapCase heap_case = LoadHeapCase(CampaignFolder{folder}.trial(trial.id) / "case.json");
    EXPECT_EQ(heap_case.coarse_graining.scale_factor, trial.scale_factor);
  }
  EXPECT_EQ(factors, (std::set<double>{1, 2}));
}

TEST_F(JointCampaign, AnInterruptedOneGoesOnAsIfNothingHadHappened) {
  const fs::path whole = Begin(kTwoSizes, "whole");
  RunFake(whole, {});
  const fs::path cut = Begin(kTwoSizes, "cut");
  RunFake(cut, {});
  Database(JournalPath(cut), Database::Mode::kReadWrite)
      .Execute(
          "DELETE FROM profiles WHERE trial > 7; DELETE FROM metrics WHERE trial > 7;"
          "DELETE FROM points WHERE trial > 7; DELETE FROM trials WHERE id > 7");
  EXPECT_EQ(RunFake(cut, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(cut), TrialTable(whole));
}

TEST_F(JointCampaign, ItEndsWhenItsCoreTimeIsUsed) {
  const fs::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"core_time": "1 us"}, "confirm": {"candidates": 0}, "workers": 1)");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials(folder).size(), 1u);  // a process takes longer than that
  EXPECT_THAT(Result(folder).stop_reason, HasSubstr("core time is used"));
}

}  // namespace
}  // namespace talus::experiments
