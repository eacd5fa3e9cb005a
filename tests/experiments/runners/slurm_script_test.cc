// What a batch's script makes of the spec, and what its set-up may do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "tests/experiments/slurm_fixture.h"

namespace talus::runners {
namespace slurm_script_test {

using ::testing::HasSubstr;

class SlurmScript : public SlurmRunnerTest {};

// A line break in the folder's name ended the comment that the script keeps it in, and bash ran
// what followed.
TEST_F(SlurmScript, NamesAreNeverExecuted) {
  const std::string mark = (root_ / "executed").string();
  for (const std::string& name : std::vector<std::string>{
           "$(touch " + mark + ")", "`touch " + mark + "`", "'; touch " + mark + "; '",
           "\"; touch " + mark + "; \"", "; touch " + mark + " #", "% j & | > < * \\"}) {
    std::string folder = name;
    std::replace(folder.begin(), folder.end(), '/', '_');
    SlurmRunner runner(options_, root_ / folder);
    Job job = Shell(1, "echo \"$0\"");
    job.command.push_back(name);
    job.folder = root_ / folder / "trials" / "1";
    fs::create_directories(job.folder);
    runner.Submit({&job, 1});
    ASSERT_EQ(Finish(runner, 1).size(), 1u) << name;
    EXPECT_EQ(base::ReadFile(job.folder / "log.txt"), name + "\n");
    EXPECT_FALSE(fs::exists(root_ / "executed")) << name;
  }
}

TEST_F(SlurmScript, LineBreaksInNamesAreRefused) {
  const std::string script = "a\ntouch executed\n";
  SlurmRunner runner(options_, root_ / "campaign");
  Job job = Shell(1, script);
  EXPECT_THROW(runner.Submit({&job, 1}), base::ConfigError);
  Job folder = Shell(2, "true");
  folder.folder = root_ / script;
  EXPECT_THROW(runner.Submit({&folder, 1}), base::ConfigError);
  EXPECT_EQ(Text("submitted"), "");
}

TEST(SlurmOptions, OnlyNamesAreNames) {
  for (const char* bad : {"a\nb", "a --wrap=x", "$(x)", "`x`", "'", "\"", ";", "-p", "a\x1b[2J"}) {
    for (std::string SlurmOptions::*field : {&SlurmOptions::partition, &SlurmOptions::account,
                                             &SlurmOptions::qos, &SlurmOptions::memory}) {
      SlurmOptions options;
      options.*field = bad;
      base::Problems problems;
      options.Validate(problems);
      EXPECT_EQ(problems.size(), 1u) << bad;
    }
  }
  SlurmOptions options;
  options.modules = {"gcc\nrm"};
  options.setup = {"a\rb"};
  options.directives = {"--x\ny"};
  base::Problems problems;
  options.Validate(problems);
  EXPECT_EQ(problems.size(), 3u);
}

// sbatch takes them before the script's lines: a name that talus does not know, and a limit of five
// minutes for trials of hours. What the script leaves open stays the user's.
TEST_F(SlurmScript, TheEnvironmentDoesNotOverrideTheScript) {
  const std::pair<const char*, const char*> variables[] = {{"SBATCH_JOB_NAME", "mine"},
                                                           {"SBATCH_TIMELIMIT", "5"},
                                                           {"SBATCH_CLUSTERS", "other"},
                                                           {"SBATCH_PARTITION", "short"}};
  for (const auto& [name, value] : variables) ::setenv(name, value, 1);
  SlurmRunner runner(options_, root_ / "campaign");
  Job job = Shell(1, "true");
  job.time_cap = 7200;
  runner.Submit({&job, 1});
  for (const auto& [name, value] : variables) ::unsetenv(name);
  EXPECT_EQ(Text("environment"), "SBATCH_PARTITION=short\n");
}

TEST(SlurmOptions, WhatTalusTellsSbatchItselfIsNoDirective) {
  for (const char* own : {"--job-name=powder", "-J powder", "--array=0-9%2", "-a0-9", "--time=5",
                          "--cluster=gpu", "-Mgpu", "--out x", "--wait"}) {
    SlurmOptions options;
    options.directives = {own};
    base::Problems problems;
    options.Validate(problems);
    EXPECT_EQ(problems.size(), 1u) << own;
  }
  SlurmOptions options;
  options.directives = {"--constraint=avx512", "-C avx512",   "--no-requeue",
                        "--mem-per-cpu=1G",    "--exclusive", "--gres=gpu:1"};
  base::Problems problems;
  options.Validate(problems);
  EXPECT_EQ(problems.size(), 0u);
}

TEST_F(SlurmScript, ASetUpThatEndsWith255IsNoFailureOfTheTrial) {
  options_.setup = {"exit 255"};
  SlurmRunner runner(options_, root_ / "campaign");
  const Job job = Shell(1, "true");
  runner.Submit({&job, 1});
  Put("queue", "101_0|FAILED|NonZeroExitCode\n");
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kNotStarted);
}

TEST_F(SlurmScript, WhatTheSpecAsksForStandsInTheScript) {
  options_.partition = "main";
  options_.account = "powder";
  options_.memory = "2G";
  options_.cores = 4;
  options_.ranks = 3;
  options_.modules = {"gcc/12"};
  options_.directives = {"--constraint=avx512"};
  options_.setup = {"export A=1"};
  Job job = Shell(1, "true");
  job.time_cap = 61;
  const std::string script =
      BatchScript({.number = 1, .job_name = "talus-x-1", .jobs = {job}}, options_, root_ / "batch");
  for (const char* line : {"--partition=main\n", "--account=powder\n", "--mem=2G\n", "--ntasks=3\n",
                           "--cpus-per-task=4\n", "#SBATCH --constraint=avx512\n", "--time=2\n",
                           "module load 'gcc/12' || exit 1\n", "\nexport A=1\n"}) {
    EXPECT_THAT(script, HasSubstr(line));
  }
}

// Where the set-up had gone elsewhere the command ran there, and where it had said `set -e` nothing
// said how a failing one had ended.
TEST_F(SlurmScript, ASetUpMayGoElsewhereAndEndAtFailures) {
  options_.setup = {"cd /", "set -euo pipefail"};
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "touch ran; exit 3")};
  runner.Submit(jobs);
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kExit);
  EXPECT_EQ(finished[0].exit_status, 3);
  EXPECT_TRUE(fs::exists(root_ / "trials/1/ran"));
}

// It would count as failed trials of the parameters, and teach the search that they fail.
TEST_F(SlurmScript, ASetUpThatFailsIsNoFailureOfTheTrial) {
  options_.setup = {"echo no such module >&2; exit 7"};
  SlurmRunner runner(options_, root_ / "campaign");
  Program("sbatch", std::string(kSbatch).replace(std::string(kSbatch).find(">/dev/null 2>&1; done"),
                                                 21, R"(>"${2%.sh}-$task.log" 2>&1; done)"));
  const Job jobs[] = {Shell(1, "touch ran")};
  runner.Submit(jobs);
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kNotStarted);
  EXPECT_THAT(finished[0].reason, HasSubstr("exit status 7"));
  EXPECT_THAT(finished[0].reason, HasSubstr("no such module"));
  EXPECT_THAT(finished[0].reason, HasSubstr("slurm/batch-000001-0.log"));
  EXPECT_FALSE(fs::exists(root_ / "trials/1/ran"));
}

// Its end was written where the set-up had gone, and the trial counted as one that had failed.
TEST_F(SlurmScript, ASetUpThatFailsElsewhereIsNoFailureOfTheTrial) {
  fs::create_directories(root_ / "elsewhere");
  options_.setup = {"cd " + (root_ / "elsewhere").string(), "false || exit 7"};
  SlurmRunner runner(options_, root_ / "campaign");
  const Job jobs[] = {Shell(1, "touch ran"), Shell(2, "touch ran")};
  runner.Submit(jobs);
  const auto finished = Finish(runner, 2);
  ASSERT_EQ(finished.size(), 2u);
  for (const FinishedJob& job : finished) EXPECT_EQ(job.end, JobEnd::kNotStarted);
  EXPECT_TRUE(fs::is_empty(root_ / "elsewhere"));
}

// What the failed set-up has left in the trial's folder was taken for the end of every later try.
TEST_F(SlurmScript, AfterASetUpThatFailedTheJobIsSubmittedAnew) {
  const Job jobs[] = {Shell(1, "touch ran")};
  options_.setup = {"exit 7"};
  {
    SlurmRunner runner(options_, root_ / "campaign");
    runner.Submit(jobs);
    ASSERT_EQ(Finish(runner, 1).size(), 1u);
  }
  options_.setup.clear();
  SlurmRunner runner(options_, root_ / "campaign");
  EXPECT_FALSE(runner.Adopt(jobs[0], ""));
  runner.Submit(jobs);
  const auto finished = Finish(runner, 1);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_TRUE(finished[0].ok());
  EXPECT_TRUE(fs::exists(root_ / "trials/1/ran"));
}

}  // namespace slurm_script_test
}  // namespace talus::runners
