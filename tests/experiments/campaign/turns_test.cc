#include "experiments/campaign/plan/turns.h"

#include <gtest/gtest.h>

#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace turns_test {

journal::TrialRecord Trial(std::int64_t id, double due) {
  journal::TrialRecord trial;
  trial.id = id;
  trial.due = due;
  return trial;
}

TEST(NextInTurn, IsTheRunningTrialThatIsDueFirst) {
  std::vector<journal::TrialRecord> trials{Trial(1, 5), Trial(2, 3), Trial(3, 3), Trial(4, 8)};
  EXPECT_EQ(NextInTurn(trials), 2);
  trials[1].status = journal::TrialStatus::kOk;
  EXPECT_EQ(NextInTurn(trials), 3);
  trials[2].status = journal::TrialStatus::kFailed;
  EXPECT_EQ(NextInTurn(trials), 1);
  for (journal::TrialRecord& trial : trials) trial.status = journal::TrialStatus::kOk;
  EXPECT_EQ(NextInTurn(trials), std::nullopt);
}

TEST(MostBegun, HasSpareTrialsForIdleCoresButNotForOneAndNotInAQueue) {
  CampaignSpec spec;
  EXPECT_EQ(MostBegun(spec, 1), 1);
  EXPECT_EQ(MostBegun(spec, 2), 3);
  EXPECT_EQ(MostBegun(spec, 16), 31);
  spec.runner.kind = RunnerKind::kSlurm;
  EXPECT_EQ(MostBegun(spec, 50), 50);
}

using TurnsTest = CampaignFixture;

TEST_F(TurnsTest, TheClockGoesByWhatTrialsWereExpectedToCostAndLearnsFromWhatTheyDid) {
  const std::filesystem::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]})");
  const CampaignSpec spec = ParseSpecText(
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json);
  Turns turns(spec);
  journal::TrialRecord fine = Trial(1, 0);
  journal::TrialRecord coarse = Trial(2, 0);
  coarse.scale_factor = 2;
  fine.due = turns.DueOf(fine);
  coarse.due = turns.DueOf(coarse);
  // An eighth of the grains, twice the time step: the same heights of fall take as long.
  EXPECT_GT(coarse.due, 0);
  EXPECT_NEAR(fine.due / coarse.due, 16, 4);

  coarse.num_particles = 100;
  coarse.num_steps = 1'000'000;
  turns.Told(coarse);
  const double seconds = 100 * 1e6 / kUsualSpeed;
  EXPECT_DOUBLE_EQ(turns.DueOf(coarse), coarse.due + seconds);
  // The other kind waits as many times as long as was estimated.
  EXPECT_NEAR((turns.DueOf(fine) - coarse.due) / seconds, fine.due / coarse.due, 1e-9);

  // One that is told late does not turn the clock back.
  journal::TrialRecord early = coarse;
  early.due = coarse.due / 2;
  turns.Told(early);
  EXPECT_DOUBLE_EQ(turns.DueOf(coarse), coarse.due + seconds);
}

}  // namespace turns_test
}  // namespace talus::campaign
