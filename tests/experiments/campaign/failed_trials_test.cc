// Trials that have failed, in a campaign that is gone on with.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace failed_trials_test {

namespace fs = std::filesystem;

constexpr const char* kFive = R"(, "budget": {"simulations": 5}, "workers": 1,
    "strategy": {"kind": "sobol"}, "confirm": {"candidates": 0})";

using FailedTrials = CampaignFixture;

// Fewer than eight stayed failed, and the search kept away from sets that nothing was wrong with.
TEST_F(FailedTrials, AFewAreRunAgainWhereNoneHasSucceeded) {
  const fs::path folder = Begin(kFive);
  ASSERT_EQ(RunFake(folder, {.fail_first = 5}), CampaignEnd::kFailed);
  ASSERT_EQ(RunFake(folder, {}, {.add_simulations = 3}), CampaignEnd::kFinished);
  std::string eight = kFive;
  eight.replace(eight.find(": 5"), 3, ": 8");
  const fs::path calm = Begin(eight, "calm");
  ASSERT_EQ(RunFake(calm, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), TrialTable(calm));
}

// It became smaller: 8 that were to be run again counted as used.
TEST_F(FailedTrials, LeaveTheBudgetOfASetUpThatIsMended) {
  std::string sixteen = kFive;
  sixteen.replace(sixteen.find(": 5"), 3, R"(: 16, "core_time": "1 h")");
  const fs::path folder = Begin(sixteen);
  ASSERT_EQ(RunFake(folder, {.fail_first = 16}), CampaignEnd::kFailed);
  ASSERT_EQ(Trials(folder).size(), 8u);
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  const CampaignSpec spec = OpenCampaign(folder, {.add_simulations = 5}, console).spec;
  EXPECT_EQ(spec.budget.simulations, 21);
  EXPECT_GT(spec.budget.core_time.value(), 3600);
}

// The ended search was open again, and none of them was tried.
TEST_F(FailedTrials, AreTriedOnceMoreWhereTheSpecAllowsItLater) {
  const fs::path folder = Begin(kFive);
  const FakeEngineOptions engine{.fail_first = 2};
  ASSERT_EQ(RunFake(folder, engine), CampaignEnd::kFinished);
  const auto before = Trials(folder);
  WriteFakeSpec(scratch_.path() / "run_in", std::string(kFive) + R"(, "retry_failed": true)");
  ASSERT_EQ(RunFake(folder, engine), CampaignEnd::kFinished);
  const auto after = Trials(folder);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].attempts, i < 2 ? 2 : 1);
    EXPECT_EQ(after[i].seed == before[i].seed, i >= 2);
  }
}

}  // namespace failed_trials_test
}  // namespace talus::campaign
