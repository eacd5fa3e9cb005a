// What the Slurm runner makes of what Slurm answers, or does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/runners/slurm_verdict.h"
#include "tests/experiments/slurm_fixture.h"

namespace talus::runners {
namespace slurm_answers_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SlurmAnswers : public SlurmRunnerTest {};

TEST_F(SlurmAnswers, JobThatSlurmHasForgottenIsLookedUpInItsAccounting) {
  Put("hold", "");
  options_.result_delay = 0;
  options_.max_requeues = 0;
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true")};
  runner.Submit(jobs);
  Put("accounting", "101_0|CANCELLED by 1000\n");
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_THAT(finished[0].reason, HasSubstr("was cancelled in Slurm (by 1000)"));
  EXPECT_THAT(finished[1].reason, HasSubstr("no longer known to Slurm"));
}

// The array was known by its other task, and the accounting was not asked.
TEST_F(SlurmAnswers, ATaskThatSlurmHasForgottenIsLookedUpWhileItsArrayIsKnown) {
  Put("hold", "");
  options_.result_delay = 0;
  options_.max_requeues = 0;
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true")};
  runner.Submit(jobs);
  Put("accounting", "101_0|TIMEOUT\n101_1|COMPLETED\n");
  Put("queue", "101_1|RUNNING|None\n");
  const auto finished = Finish(runner, 2, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, 1);
  EXPECT_EQ(finished[0].end, JobEnd::kTimeCap);
}

TEST_F(SlurmAnswers, RefusedBatchIsReportedAndABusyClusterIsTriedAgain) {
  SlurmRunner runner(options_, root_ / "campaign");
  Put("hold_sbatch", "sbatch: error: invalid partition specified: mian");
  const Job first[] = {Shell(1, "true")};
  EXPECT_THAT(runner.Submit(first), ElementsAre(""));
  auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kNotStarted);
  EXPECT_THAT(finished[0].reason, HasSubstr("invalid partition"));

  Put("hold_sbatch", "sbatch: error: Unable to contact slurm controller (connect failure)");
  const Job second[] = {Shell(2, "true")};
  runner.Submit(second);
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  fs::remove(root_ / "hold_sbatch");
  finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_TRUE(finished[0].ok());
}

TEST_F(SlurmAnswers, WhatABusyClusterHasNotTakenIsSaidAndMayBeTakenBack) {
  SlurmRunner runner(options_, root_ / "campaign");
  EXPECT_EQ(runner.Trouble(), "");
  Put("hold_sbatch", "sbatch: error: Unable to contact slurm controller (connect failure)");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  EXPECT_THAT(runner.Trouble(), HasSubstr("Unable to contact slurm controller"));
  EXPECT_THAT(runner.TakeBackUnsent(), ElementsAre(1));
  EXPECT_EQ(runner.Trouble(), "");
  fs::remove(root_ / "hold_sbatch");
  EXPECT_TRUE(Finish(runner, 1, 0.3).empty());
  EXPECT_FALSE(fs::exists(root_ / "submitted"));
}

TEST_F(SlurmAnswers, ASlurmThatDoesNotAnswerIsSaid) {
  Put("hold", "");
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  Put("queue_is_down", "");
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  EXPECT_THAT(runner.Trouble(),
              HasSubstr("squeue does not say how the jobs are: Unable to contact"));
  fs::remove(root_ / "queue_is_down");
  Put("queue", "101_0|RUNNING|None|0:01\n");
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  EXPECT_EQ(runner.Trouble(), "");
}

TEST_F(SlurmAnswers, JobsThatSlurmHasNotBegunAreWaiting) {
  Put("hold", "");
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true")};
  runner.Submit(jobs);
  EXPECT_EQ(runner.NumWaiting(), 2);
  Put("queue", "101_0|RUNNING|None|0:01\n101_1|PENDING|Priority|0:00\n");
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  EXPECT_EQ(runner.NumWaiting(), 1);
}

TEST_F(SlurmAnswers, AJobThatSlurmHasEndedTookAsLongAsSlurmSays) {
  Put("hold", "");
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|TIMEOUT|TimeLimit|1:02:03\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kTimeCap);
  EXPECT_EQ(finished[0].duration, 3723);
}

// Slurm says the same of a queue that is full for now and of a job that is too large for ever.
TEST_F(SlurmAnswers, AJobThatIsTooLargeIsRefusedOnceNothingElseIsQueued) {
  SlurmRunner runner(options_, root_ / "campaign");
  Put("hold_sbatch",
      "sbatch: error: Job violates accounting/QOS policy (job submit limit, user's size and/or "
      "time "
      "limits)");
  Put("queue", "77|RUNNING|None\n");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  Put("queue", "");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kNotStarted);
  EXPECT_THAT(finished[0].reason, HasSubstr("QOS policy"));
}

TEST(SlurmVerdict, MemoryKillWithoutCgroupsIsSeenInTheLog) {
  EXPECT_EQ(VerdictOf({"FAILED", "JobLaunchFailure"}, "error: Exceeded job memory limit\n").end,
            JobEnd::kOutOfMemory);
  const Verdict failed = VerdictOf({"FAILED", "NonZeroExitCode"}, "a\nmodule: not found\n");
  EXPECT_EQ(failed.end, JobEnd::kSignal);
  EXPECT_THAT(failed.reason, HasSubstr("without a result: module: not found"));
}

// The lines that Slurm 22.05 writes.
TEST(SlurmVerdict, LimitsOfAForgottenJobAreSeenInTheLog) {
  EXPECT_EQ(VerdictOf({kLost, ""},
                      "slurmstepd: error: *** JOB 12 ON n1 CANCELLED AT 2026-11-21T05:00:00 DUE TO "
                      "TIME LIMIT ***\n")
                .end,
            JobEnd::kTimeCap);
  EXPECT_EQ(VerdictOf({kLost, ""}, "slurmstepd: error: Detected 1 oom-kill event(s) in step\n").end,
            JobEnd::kOutOfMemory);
  EXPECT_EQ(VerdictOf({kLost, ""}, "").end, JobEnd::kNodeFailure);
}

TEST(SlurmQueue, TimesAreReadAsSlurmWritesThem) {
  EXPECT_EQ(ParseElapsed("1-02:03:04"), 93784);
  EXPECT_EQ(ParseElapsed("03:04"), 184);
  EXPECT_EQ(ParseElapsed("INVALID"), 0);
  EXPECT_EQ(ParseSacct("7_0|CANCELLED by 0|00:00:09\n").at("7_0").elapsed, 9);
}

TEST(SlurmQueue, OnlyStatesThatMayGoOnAreUnfinished) {
  for (const char* name : {"PENDING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED",
                           "RESV_DEL_HOLD", "SPECIAL_EXIT", "POWER_UP_NODE", "OF_A_LATER_SLURM"}) {
    EXPECT_TRUE(IsUnfinished({name, ""})) << name;
  }
  for (const char* name :
       {"COMPLETED", "FAILED", "TIMEOUT", "NODE_FAIL", "BOOT_FAIL", "REVOKED", kLost}) {
    EXPECT_FALSE(IsUnfinished({name, ""})) << name;
  }
}

// A cluster's own greeting may stand before it.
TEST(SlurmQueue, TheJobIsTheLastNumberThatBeginsALine) {
  EXPECT_EQ(ParseSubmitted("101\n"), "101");
  EXPECT_EQ(ParseSubmitted("Welcome to rack 7\n\n102;rack\n"), "102");
  EXPECT_EQ(ParseSubmitted("103_[0-3]"), "103");
  EXPECT_EQ(ParseSubmitted("not today\n"), "");
}

TEST(SlurmVerdict, ADeadlineIsATimeLimit) {
  EXPECT_EQ(VerdictOf({"DEADLINE", ""}, "").end, JobEnd::kTimeCap);
  EXPECT_FALSE(VerdictOf({"DEADLINE", ""}, "").requeue);
}

TEST(SlurmVerdict, EitherSpellingOfAMemoryKillIsOne) {
  for (const char* log :
       {"Detected 1 oom-kill event(s)", "Detected 1 oom_kill event", "Exceeded job memory limit"}) {
    EXPECT_EQ(VerdictOf({"FAILED", "NonZeroExitCode"}, log).end, JobEnd::kOutOfMemory) << log;
  }
}

}  // namespace slurm_answers_test
}  // namespace talus::runners
