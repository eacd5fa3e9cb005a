#include "experiments/campaign/plan/cores.h"

#include <gmock/gmock.h>

#include "experiments/campaign/plan/core_time.h"

namespace talus::campaign {
namespace cores_test {

using ::testing::HasSubstr;

CampaignSpec WithRanks(int workers, int ranks, int threads) {
  CampaignSpec spec;
  spec.workers = workers;
  spec.threads = threads;
  spec.engine.kind = EngineKind::kCommand;
  spec.engine.command.ranks = ranks;
  return spec;
}

TEST(Cores, TrialsAtATimeAreAsManyAsFit) {
  EXPECT_EQ(LocalWorkers(WithRanks(0, 1, 1), 8), 8);
  EXPECT_EQ(LocalWorkers(WithRanks(0, 2, 2), 8), 2);
  EXPECT_EQ(LocalWorkers(WithRanks(0, 3, 1), 8), 2);
  EXPECT_EQ(LocalWorkers(WithRanks(0, 16, 1), 8), 1);  // too many, but one must run
  EXPECT_EQ(LocalWorkers(WithRanks(5, 2, 2), 8), 5);   // as asked for
  CampaignSpec own = WithRanks(0, 4, 2);
  own.engine.kind = EngineKind::kTalus;  // it has threads only
  EXPECT_EQ(LocalWorkers(own, 8), 4);
}

TEST(Cores, AQueueRunsAsManyTrialsAsItMayHold) {
  CampaignSpec spec = WithRanks(0, 2, 2);
  EXPECT_EQ(MostAtATime(spec, 8), 2);
  spec.runner.kind = RunnerKind::kSlurm;
  spec.runner.slurm.max_jobs = 20;
  EXPECT_EQ(MostAtATime(spec, 8), 20);
  spec.workers = 7;
  EXPECT_EQ(MostAtATime(spec, 8), 7);
  spec.workers = 200;
  EXPECT_EQ(MostAtATime(spec, 8), 20);
}

// The loops of a strategy take the others.
TEST(Cores, TrialsTakeTheirCoresHereButNoneOfAQueue) {
  CampaignSpec spec = WithRanks(3, 2, 2);
  EXPECT_EQ(CoresTaken(spec, 0), 0);
  EXPECT_EQ(CoresTaken(spec, 2), 8);
  EXPECT_EQ(CoresTaken(spec, 5), 12);  // two of them wait
  spec.runner.kind = RunnerKind::kSlurm;
  EXPECT_EQ(CoresTaken(spec, 5), 0);
}

TEST(Cores, MoreThanTheMachineHasIsWarnedOf) {
  EXPECT_FALSE(CoresWarning(WithRanks(2, 2, 2), 8).has_value());
  EXPECT_FALSE(CoresWarning(WithRanks(0, 8, 1), 8).has_value());
  EXPECT_THAT(CoresWarning(WithRanks(3, 2, 2), 8).value(),
              HasSubstr("trials take 12 cores (3 at a time x 2 MPI ranks x 2 threads), and this "
                        "machine has 8: each waits for the others; set \"workers\" to 2"));
  EXPECT_THAT(CoresWarning(WithRanks(0, 16, 1), 8).value(), HasSubstr("set fewer ranks"));
  CampaignSpec elsewhere = WithRanks(3, 2, 2);
  elsewhere.runner.kind = RunnerKind::kSlurm;
  EXPECT_FALSE(CoresWarning(elsewhere, 8).has_value());
}

// The ranks that srun starts are no children of the job's script: it sees srun's own time only.
TEST(Cores, RanksThatSlurmStartsCountAsLongAsTheyHadTheirCores) {
  journal::TrialRecord trial;
  trial.status = journal::TrialStatus::kOk;
  trial.duration_s = 100;
  trial.cpu_s = 2;
  CampaignSpec spec = WithRanks(0, 64, 1);
  EXPECT_EQ(MeasuredCoreTime(trial, spec), 2);
  spec.runner.kind = RunnerKind::kSlurm;
  EXPECT_EQ(MeasuredCoreTime(trial, spec), 6400);
  EXPECT_EQ(CoreTime(spec).OfSearch({trial, trial}), 12800);
  spec.engine.kind = EngineKind::kTalus;
  EXPECT_EQ(MeasuredCoreTime(trial, spec), 2);
}

// Stopped after a second and started again, it was taken for one of a second.
TEST(Cores, ATrialThatRunsCountsAsLongAsOthersTook) {
  CampaignSpec spec = WithRanks(0, 1, 1);
  journal::TrialRecord ended;
  ended.status = journal::TrialStatus::kOk;
  ended.cpu_s = 60;
  journal::TrialRecord runs;
  runs.cpu_s = 1;
  EXPECT_EQ(CoreTime(spec).OfSearch({ended, runs}), 120);
  runs.cpu_s = 70;  // longer than usual already
  EXPECT_EQ(CoreTime(spec).OfSearch({ended, runs}), 130);
}

}  // namespace cores_test
}  // namespace talus::campaign
