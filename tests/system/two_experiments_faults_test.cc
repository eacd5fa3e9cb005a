// What may happen to a campaign of two experiments from outside, as campaign_faults_test.cc has it
// for one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/files/file.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "tests/experiments/two_experiments.h"
#include "tests/system/session.h"

namespace talus::campaign {
namespace two_experiments_faults_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class TwoExperimentsFaults : public TwoExperiments {
 protected:
  static std::vector<journal::TrialRecord> Trials(const fs::path& folder) {
    return journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Trials();
  }
  // All of the result but its cost, which no two runs share.
  static std::string Recommended(const fs::path& folder) {
    Answer result = ParseAnswer(base::ReadFile(folder / "result.json"));
    result.cost = {};
    return AnswerJson(result);
  }
};

TEST_F(TwoExperimentsFaults, KilledAtManyMomentsItComesToTheSameEnd) {
  const fs::path calm = Finished("calm");
  const fs::path folder = Begin("killed");
  base::Random random(2, base::Stream("moments of death"));
  int kills = 0;
  for (int session = 0; session < 200; ++session) {
    // Longer and longer, so that a slow machine gets on too, by a factor, so that it soon does.
    const double lifetime = random.Uniform(0.005, 0.05 * std::pow(1.25, session));
    const int end = WaitForExit(StartSession(folder, {.sleep = 0.01}, {.lifetime = lifetime}));
    if (end == static_cast<int>(CampaignEnd::kFinished)) break;
    ASSERT_EQ(end, -SIGKILL);
    ++kills;
  }
  EXPECT_GE(kills, 3);
  EXPECT_EQ(TrialTable(folder), TrialTable(calm));
  EXPECT_EQ(Recommended(folder), Recommended(calm));
}

// A set that one test cannot simulate is still told by the other, and the report counts the
// failures.
TEST_F(TwoExperimentsFaults, AFailedTrialOfOneExperimentLeavesTheOtherTrialsAndTheCampaignEnds) {
  const fs::path folder = Begin("run", "23 mg", 40);
  EXPECT_EQ(RunFake(folder, {.fail_fast_at_low = true}), CampaignEnd::kFinished);
  int failed = 0;
  bool told_by_the_other = false;
  for (const journal::TrialRecord& trial : Trials(folder)) {
    const bool low = trial.native[0] < 0.3;
    if (trial.experiment == 0) {
      EXPECT_EQ(trial.status, journal::TrialStatus::kOk) << trial.id;
      told_by_the_other |= low;
      continue;
    }
    EXPECT_EQ(trial.status == journal::TrialStatus::kFailed, low) << trial.id;
    if (trial.status != journal::TrialStatus::kFailed) continue;
    ++failed;
    EXPECT_THAT(trial.reason, HasSubstr("no heap"));
  }
  EXPECT_GT(failed, 0);
  EXPECT_TRUE(told_by_the_other);
  const Answer result = ParseAnswer(base::ReadFile(folder / "result.json"));
  EXPECT_LT(result.parameters[0].credible_low, kTrueSliding);
  EXPECT_GT(result.parameters[0].credible_high, kTrueSliding) << AnswerSummary(result, folder);
  EXPECT_EQ(result.cost.num_failed, failed);
  const std::string page =
      analysis::PageJson(analysis::MakeReportData(analysis::GatherEvidence(folder, "fast lift")));
  EXPECT_THAT(page, HasSubstr("\"failed\":" + std::to_string(failed)));
}

TEST_F(TwoExperimentsFaults, KilledWorkersOfBothAreRunAgain) {
  const fs::path calm = Finished("calm");
  const fs::path folder = Begin("workers");
  EXPECT_EQ(RunFake(folder, {.die_once = true}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), TrialTable(calm));
  EXPECT_EQ(Recommended(folder), Recommended(calm));
}

}  // namespace two_experiments_faults_test
}  // namespace talus::campaign
