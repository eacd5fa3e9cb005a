// The Slurm runner with stand-ins for Slurm's commands.
#include "experiments/runners/slurm_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "tests/experiments/slurm_fixture.h"

namespace talus::runners {
namespace slurm_runner_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(SlurmRunnerTest, JobsGivenTogetherAreOneArrayAndTellHowTheyEnded) {
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(7, "echo \"it's $PWD\""), Shell(8, "exit 3"), Shell(9, "kill -9 $$")};
  EXPECT_THAT(runner.Submit(jobs), ElementsAre("101_0", "101_1", "101_2"));
  EXPECT_THAT(Text("campaign/slurm/batch-000001.sh"), HasSubstr("--job-name=campaign-talus-"));
  Put("queue", "101_0|COMPLETED|None\n101_1|FAILED|NonZeroExitCode\n101_2|OUT_OF_MEMORY|\n");
  const auto finished = Finish(runner, 3);
  ASSERT_EQ(finished.size(), 3u);
  EXPECT_TRUE(finished[0].ok());
  EXPECT_EQ(finished[1].end, JobEnd::kExit);
  EXPECT_EQ(finished[1].exit_status, 3);
  EXPECT_EQ(finished[2].end, JobEnd::kOutOfMemory);
  EXPECT_EQ(Text("trials/7/log.txt"), "it's " + jobs[0].folder.string() + "\n");
  EXPECT_FALSE(finished[0].host.empty());
}

// As on one machine: whoever killed it says nothing of its parameters.
TEST_F(SlurmRunnerTest, ACommandThatOthersKilledIsRunAgain) {
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "kill -9 $$"), Shell(2, "kill -SEGV $$")};
  runner.Submit(jobs);
  Put("queue", "101_0|FAILED|NonZeroExitCode\n101_1|FAILED|NonZeroExitCode\n");
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[0].end, JobEnd::kPreempted);
  EXPECT_EQ(finished[1].end, JobEnd::kSignal);
}

// Two hours at the limit, on 3 ranks of 2 cores: a later attempt's seconds were all that counted.
TEST_F(SlurmRunnerTest, ATimedOutJobHasTakenItsCores) {
  options_.cores = 2;
  options_.ranks = 3;
  Put("hold", "");
  SlurmRunner runner(options_, root_ / "campaign");
  const Job job = Shell(1, "true");
  runner.Submit({&job, 1});
  Put("queue", "101_0|TIMEOUT|TimeLimit|2:00:00\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kTimeCap);
  EXPECT_DOUBLE_EQ(finished[0].duration, 7200);
  EXPECT_DOUBLE_EQ(finished[0].cpu_time, 6 * 7200);
}

TEST_F(SlurmRunnerTest, LaterProcessFindsTheJobsOfAnEarlierOne) {
  Put("hold", "");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true"), Shell(3, "true")};
  {
    SlurmRunner runner(options_, root_ / "campaign");
    runner.Submit(jobs);
  }
  SlurmRunner runner(options_, root_ / "campaign");
  Job unknown = Shell(4, "true");
  Job next_attempt = jobs[0];
  next_attempt.attempt = 2;
  EXPECT_FALSE(runner.Adopt(unknown, ""));
  EXPECT_FALSE(runner.Adopt(next_attempt, ""));
  for (const Job& job : jobs) EXPECT_TRUE(runner.Adopt(job, ""));
  // Slurm names tasks that have never run by their array alone.
  Put("queue", "101|CANCELLED|None\n101_1|TIMEOUT|TimeLimit\n101_2|RUNNING|None\n");
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[0].end, JobEnd::kCancelled);
  EXPECT_EQ(finished[1].end, JobEnd::kTimeCap);
  EXPECT_EQ(Text("submitted").find('\n') + 1, Text("submitted").size());  // one line: one batch
}

// The process was killed after sbatch was started and before it had answered.
TEST_F(SlurmRunnerTest, SubmissionWithoutAnAnswerIsLookedUpByName) {
  Put("hold", "");
  const Job jobs[] = {Shell(1, "true")};
  SlurmRunner(options_, root_ / "campaign").Submit(jobs);
  fs::remove(root_ / "campaign/slurm/batch-000001.job");
  {
    SlurmRunner runner(options_, root_ / "campaign");
    Put("queue_is_down", "");
    EXPECT_THROW(runner.Adopt(jobs[0], ""), base::Error);  // nobody can tell
    fs::remove(root_ / "queue_is_down");
    EXPECT_FALSE(runner.Adopt(jobs[0], ""));  // Slurm has never got it
  }
  Put("found", "555_0|RUNNING\n");
  SlurmRunner runner(options_, root_ / "campaign");
  ASSERT_TRUE(runner.Adopt(jobs[0], ""));
  Put("queue", "555_0|OUT_OF_MEMORY|None\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kOutOfMemory);
}

TEST_F(SlurmRunnerTest, NodeFailureAndPreemptionAreSubmittedAgainAndRecorded) {
  Put("hold", "");
  options_.max_requeues = 1;
  options_.result_delay = 20;  // a job that squeue does not name is waited for
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|NODE_FAIL|None|1:00:00\n101_1|PREEMPTED|None\n");
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  Put("queue", "102_0|NODE_FAIL|None|0:00:01\n103_0|PREEMPTED|None\n");
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[0].end, JobEnd::kNodeFailure);
  EXPECT_EQ(finished[1].end, JobEnd::kPreempted);
  EXPECT_THAT(finished[0].reason, HasSubstr("submitted again 1 times: it lost its node"));
  EXPECT_EQ(finished[0].duration, 3601);  // of both attempts
  // Should Slurm have lost sight of one only.
  EXPECT_EQ(base::ReadFile(root_ / "cancelled"), "101_0\n101_1\n");
}

// It was submitted a second time, and both ran in one folder.
TEST_F(SlurmRunnerTest, AStateThatIsNotKnownIsOfAJobThatGoesOn) {
  Put("hold", "");
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|POWER_UP_NODE|None\n");
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  EXPECT_EQ(runner.NumWaiting(), 1);
  EXPECT_FALSE(fs::exists(root_ / "cancelled"));
  Put("queue", "101_0|TIMEOUT|TimeLimit\n");
  EXPECT_EQ(Finish(runner, 1).size(), 1u);
}

TEST_F(SlurmRunnerTest, LateResultIsWaitedFor) {
  Put("hold", "");
  options_.result_delay = 20;
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|COMPLETED|None\n");
  EXPECT_TRUE(Finish(runner, 1, 0.5).empty());
  Put("trials/1/.slurm_end", "1 0 0 1500000 250 0 node7 end\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_TRUE(finished[0].ok());
  EXPECT_EQ(finished[0].duration, 1.5);
  EXPECT_EQ(finished[0].host, "node7");
}

// All trials had failed and were to be run again; the process ended before it had submitted them.
TEST_F(SlurmRunnerTest, AForgottenJobIsSubmittedAnewByALaterProcess) {
  const Job jobs[] = {Shell(1, "exit 3"), Shell(2, "exit 3")};
  {
    SlurmRunner runner(options_, root_ / "campaign");
    runner.Submit(jobs);
    ASSERT_EQ(Finish(runner, 2).size(), 2u);
    runner.Forget(jobs[0]);
  }
  SlurmRunner runner(options_, root_ / "campaign");
  EXPECT_FALSE(runner.Adopt(jobs[0], "101_0"));
  EXPECT_TRUE(runner.Adopt(jobs[1], "101_1"));
  runner.Submit({&jobs[0], 1});
  EXPECT_TRUE(SlurmRunner(options_, root_ / "campaign").Adopt(jobs[0], ""));
}

// Slurm has forgotten the array, one of whose tasks a signal has ended. It was taken for one that
// had never been sent, and all of its array ran again.
TEST_F(SlurmRunnerTest, AKilledJobThatALaterProcessFindsIsNotSubmittedAgain) {
  Put("hold", "");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true")};
  SlurmRunner(options_, root_ / "campaign").Submit(jobs);
  Put("trials/1/.slurm_end", "1 0 0 1500000 250 0 node7 end\n");
  Put("trials/2/.slurm_end", "1 1 139 1500000 250 0 node7 end\n");
  Put("queue", "");
  options_.result_delay = 0.1;
  SlurmRunner runner(options_, root_ / "campaign");
  for (const Job& job : jobs) EXPECT_TRUE(runner.Adopt(job, ""));
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_TRUE(finished[0].ok());
  EXPECT_EQ(finished[1].end, JobEnd::kSignal);
  EXPECT_EQ(Text("submitted").find('\n') + 1, Text("submitted").size());  // one line: one batch
}

// It waited in the queue while the set-up was mended: the script that it was submitted with is old.
TEST_F(SlurmRunnerTest, AnAdoptedJobWhoseOldSetUpFailsMayRunAgain) {
  Put("hold", "");
  Job job = Shell(1, "true");
  SlurmRunner(options_, root_ / "campaign").Submit({&job, 1});
  SlurmRunner runner(options_, root_ / "campaign");
  job.command.clear();  // as a campaign adopts it
  ASSERT_TRUE(runner.Adopt(job, ""));
  Put("trials/1/.slurm_end", "1 0 7 0 0 0 node7 set-up\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kPreempted);
  EXPECT_THAT(finished[0].reason, HasSubstr("exit status 7"));
}

TEST_F(SlurmRunnerTest, AFolderByAnotherNameHasTheSameJobs) {
  Put("hold", "");  // the job does not end
  const Job job = Shell(1, "true");
  const Job jobs[] = {job};
  SlurmRunner(options_, root_ / "campaign").Submit(jobs);
  fs::create_directory_symlink(root_, root_ / "link");
  Job again = job;
  again.folder = root_ / "link" / "." / "trials" / "1";
  EXPECT_TRUE(SlurmRunner(options_, root_ / "link" / "campaign").Adopt(again, ""));
}

TEST_F(SlurmRunnerTest, CancelledJobIsReportedOnceSlurmHasStoppedIt) {
  Put("hold", "");
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|RUNNING|None\n");
  runner.Cancel(1);
  EXPECT_TRUE(Finish(runner, 1, 0.3).empty());
  EXPECT_EQ(Text("cancelled"), "101_0\n");
  Put("queue", "101_0|CANCELLED|None\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kCancelled);
}

// Without accounting Slurm forgets such a job at once.
TEST_F(SlurmRunnerTest, AWaitingJobThatSomebodyCancelsIsNotSubmittedAgain) {
  Put("hold", "");
  options_.result_delay = 0.2;
  options_.max_requeues = 0;
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true"), Shell(3, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|RUNNING|None\n101_1|PENDING|Resources\n101_2|RUNNING|None\n");
  EXPECT_TRUE(Finish(runner, 1, 0.3).empty());
  Put("queue", "101_0|RUNNING|None\n");
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[0].id, 2);
  EXPECT_EQ(finished[0].end, JobEnd::kCancelled);
  EXPECT_EQ(finished[1].end, JobEnd::kNodeFailure);  // it had begun
}

// Ctrl-C pressed twice, then `talus resume`: the trials are run again, not recorded as failed.
TEST_F(SlurmRunnerTest, JobsCancelledByAnEarlierProcessMayRunAgain) {
  Put("hold", "");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true")};
  {
    SlurmRunner runner(options_, root_ / "campaign");
    runner.Submit(jobs);
    runner.Cancel(1);
  }
  SlurmRunner runner(options_, root_ / "campaign");
  for (const Job& job : jobs) EXPECT_TRUE(runner.Adopt(job, ""));
  Put("queue", "101_0|CANCELLED|None\n101_1|CANCELLED|None\n");
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[0].end, JobEnd::kPreempted);
  EXPECT_THAT(finished[0].reason, HasSubstr("was dropped by an earlier process"));
  EXPECT_EQ(finished[1].end, JobEnd::kCancelled);  // by somebody else, who will have had a reason
}

TEST_F(SlurmRunnerTest, SlurmIsNotAskedMoreOftenThanAllowed) {
  Put("hold", "");
  options_.poll_interval = 0.5;
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "true"), Shell(2, "true"), Shell(3, "true")};
  runner.Submit(jobs);
  Put("queue", "101_0|RUNNING|None\n101_1|PENDING|Priority\n101_2|PENDING|Priority\n");
  Finish(runner, 1, 1.8);
  const std::string calls = Text("squeue_calls");
  // 1.8 s hold three intervals of 0.5 s; a slow machine may fit in fewer.
  EXPECT_LE(std::count(calls.begin(), calls.end(), '\n'), 3);
  EXPECT_GE(std::count(calls.begin(), calls.end(), '\n'), 1);
}

}  // namespace slurm_runner_test
}  // namespace talus::runners
