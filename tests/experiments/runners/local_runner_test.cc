#include "experiments/runners/local_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/files/file.h"
#include "experiments/runners/exit_status.h"

namespace talus::runners {
namespace local_runner_test {

using ::testing::Each;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class LocalRunnerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::temp_directory_path() /
            ("talus_runner_" + std::to_string(::getpid()) + "_" +
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(root_);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  Job Shell(std::int64_t id, const std::string& script, double time_cap = 0) {
    const std::filesystem::path folder = root_ / std::to_string(id);
    std::filesystem::create_directories(folder);
    return {.id = id,
            .attempt = 1,
            .folder = folder,
            .command = {"sh", "-c", script},
            .time_cap = time_cap};
  }
  FinishedJob RunOne(const Job& job) {
    LocalRunner runner({.workers = 1});
    runner.Submit(std::span(&job, 1));
    const auto finished = runner.Wait(60);
    return finished.empty() ? FinishedJob{} : finished.front();
  }

  std::filesystem::path root_;
};

// "state parent group" of a process, "" when it is gone. Ended ones may stay as Z for long, as
// their new parent pleases.
std::string Stat(const std::string& pid) {
  std::ifstream in("/proc/" + pid + "/stat");
  std::string line;
  std::getline(in, line);
  const auto name_end = line.rfind(')');
  return name_end == std::string::npos ? "" : line.substr(name_end + 2);
}

bool Lives(pid_t pid) {
  const std::string stat = Stat(std::to_string(pid));
  return !stat.empty() && stat[0] != 'Z';
}

// True while any process of the group lives.
bool GroupLives(pid_t group) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::istringstream stat(Stat(entry.path().filename()));
    std::string state;
    pid_t parent = 0;
    pid_t its_group = 0;
    if (stat >> state >> parent >> its_group && its_group == group && state != "Z") return true;
  }
  return false;
}

bool Eventually(const auto& condition) {
  const auto start = Clock::now();
  while (!condition()) {
    if (Since(start) > 100) return false;  // a busy machine is slow
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

TEST_F(LocalRunnerTest, RunsInTheFolderWithALogAndOneSleepingThread) {
  const Job job = Shell(7, "echo out; echo err >&2; pwd; echo $OMP_NUM_THREADS$OMP_WAIT_POLICY");
  const FinishedJob done = RunOne(job);
  EXPECT_TRUE(done.ok()) << done.reason;
  EXPECT_EQ(done.id, 7);
  EXPECT_EQ(base::ReadFile(job.folder / "log.txt"),
            "out\nerr\n" + job.folder.string() + "\n1passive\n");
}

TEST_F(LocalRunnerTest, EveryWayToFailHasItsReason) {
  const FinishedJob status = RunOne(Shell(1, "exit 3"));
  EXPECT_EQ(status.end, JobEnd::kExit);
  EXPECT_EQ(status.exit_status, 3);
  EXPECT_EQ(status.reason, "exit status 3");

  const FinishedJob crash = RunOne(Shell(2, "kill -SEGV $$"));
  EXPECT_EQ(crash.end, JobEnd::kSignal);
  EXPECT_THAT(crash.reason, HasSubstr("signal 11"));

  const FinishedJob killed = RunOne(Shell(6, "kill -KILL $$"));
  EXPECT_EQ(killed.end, JobEnd::kPreempted);

  const FinishedJob slow = RunOne(Shell(3, "sleep 60", 0.1));
  EXPECT_EQ(slow.end, JobEnd::kTimeCap);

  Job absent = Shell(4, "");
  absent.command = {"talus-no-such-command"};
  EXPECT_EQ(RunOne(absent).end, JobEnd::kNotStarted);
  EXPECT_THAT(base::ReadFile(absent.folder / "log.txt"), HasSubstr("cannot be run"));

  // It ran, with nothing for the next program to find it by.
  const Job unwritten = Shell(7, "touch ran");
  std::filesystem::create_directory(unwritten.folder / ".process_group");
  const FinishedJob refused = RunOne(unwritten);
  EXPECT_EQ(refused.end, JobEnd::kNotStarted);
  EXPECT_THAT(refused.reason, HasSubstr("cannot be written: Is a directory"));
  EXPECT_FALSE(std::filesystem::exists(unwritten.folder / "ran"));

  Job nowhere = Shell(5, "true");
  nowhere.folder = root_ / "absent";
  EXPECT_EQ(RunOne(nowhere).end, JobEnd::kNotStarted);
}

TEST_F(LocalRunnerTest, TimeCapAndCancelEndWhatTheCommandHasStarted) {
  LocalRunner runner({.workers = 2});
  const Job jobs[] = {Shell(1, "sleep 60 & wait", 0.3), Shell(2, "sleep 60 & wait")};
  runner.Submit(jobs);
  pid_t group[2] = {};  // the runner's word, which is there before the commands have a core
  for (int i = 0; i < 2; ++i) std::ifstream(jobs[i].folder / ".process_group") >> group[i];
  ASSERT_GT(std::min(group[0], group[1]), 0);
  EXPECT_EQ(runner.Wait(60).at(0).id, 1);
  EXPECT_TRUE(Eventually([&] { return !GroupLives(group[0]); }));
  EXPECT_TRUE(GroupLives(group[1]));
  runner.Cancel(2);
  EXPECT_EQ(runner.Wait(60).at(0).end, JobEnd::kCancelled);
  EXPECT_TRUE(Eventually([&] { return !GroupLives(group[1]); }));
}

TEST_F(LocalRunnerTest, JobsEndWithAKilledProgramAndTheirChildrenBeforeTheFolderIsUsedAgain) {
  const Job job = Shell(1, "trap '' HUP; sleep 60 & echo $$ > pid.new; mv pid.new pid; wait");
  const pid_t program = ::fork();
  if (program == 0) {
    LocalRunner runner({.workers = 1});
    runner.Submit(std::span(&job, 1));
    runner.Wait(60);
    ::_exit(0);
  }
  ASSERT_TRUE(Eventually([&] {
    return std::filesystem::exists(job.folder / "pid") &&
           std::filesystem::exists(job.folder / ".process_group");
  }));
  pid_t group = 0;
  std::ifstream(job.folder / "pid") >> group;
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  EXPECT_TRUE(Eventually([&] { return !Lives(group); })) << "the command lives on";
  LocalRunner next({.workers = 1});
  EXPECT_FALSE(next.Adopt(job, ""));
  EXPECT_FALSE(GroupLives(group)) << "a child of the command lives on";
}

// A process group did not reach what had left it, and nothing was ended before the folder was used
// again: MPI's ranks ran on for hours.
TEST_F(LocalRunnerTest, TheWholeTreeEndsWithAKilledProgram) {
  const Job job =
      Shell(1,
            "setsid sh -c 'echo $$ > session; exec sleep 300' & "  // a session of its own
            "(sh -c 'echo $$ > orphan; exec sleep 300' &) ; "      // its parent is gone
            "echo $$ > leader; wait; sleep 300");
  const pid_t program = ::fork();
  if (program == 0) {
    LocalRunner runner({.workers = 1});
    runner.Submit(std::span(&job, 1));
    runner.Wait(60);
    ::_exit(0);
  }
  std::vector<pid_t> tree;
  for (const char* name : {"session", "orphan", "leader"}) {
    ASSERT_TRUE(Eventually([&] {
      pid_t pid = 0;
      return (std::ifstream(job.folder / name) >> pid) && Lives(pid);
    })) << name;
    std::ifstream(job.folder / name) >> tree.emplace_back();
  }
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  for (const pid_t pid : tree) EXPECT_TRUE(Eventually([&] { return !Lives(pid); }));
}

TEST_F(LocalRunnerTest, WhatACommandLeavesBehindEndsWithIt) {
  const Job job = Shell(1,
                        "setsid sh -c 'echo $$ > pid; exec sleep 300' & "
                        "until [ -s pid ]; do sleep 0.01; done");
  EXPECT_TRUE(RunOne(job).ok());
  pid_t pid = 0;
  std::ifstream(job.folder / "pid") >> pid;
  ASSERT_GT(pid, 0);
  EXPECT_TRUE(Eventually([&] { return !Lives(pid); }));
}

// A command that prints for ever filled the disk.
TEST_F(LocalRunnerTest, EndlessOutputIsStopped) {
  LocalRunner runner({.workers = 1, .threads_per_job = 1, .largest_log = 1 << 20});
  const Job job = Shell(1, "yes");
  runner.Submit(std::span(&job, 1));
  const auto finished = runner.Wait(60);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kSignal);
  EXPECT_THAT(finished[0].reason, HasSubstr("printed more than 1 MiB"));
}

// The second job ends only after the wait that must not wait for it.
TEST_F(LocalRunnerTest, WaitGivesUpWhileAJobRunsAndReportsEachJobOnce) {
  LocalRunner runner({.workers = 2});
  const Job jobs[] = {Shell(1, "true"), Shell(2, "until [ -e go ]; do sleep 0.01; done")};
  runner.Submit(jobs);
  EXPECT_EQ(runner.Wait(60).size(), 1u);
  EXPECT_TRUE(runner.Wait(0.05).empty());
  std::ofstream(jobs[1].folder / "go");
  EXPECT_EQ(runner.Wait(60).at(0).id, 2);
  EXPECT_TRUE(runner.Wait(0).empty());
}

// How long they take is measured by bench/trial_rate.
TEST_F(LocalRunnerTest, TwoHundredTrivialJobsEndOnceEach) {
  LocalRunner runner({.workers = 2});
  std::vector<Job> jobs;
  std::vector<int> num_ends(200);
  for (int id = 0; id < 200; ++id) {
    jobs.push_back(Shell(id, ""));
    jobs.back().command = {"/bin/true"};
  }
  std::size_t next = 0;
  std::size_t ended = 0;
  while (ended < jobs.size()) {
    while (next < jobs.size() && next - ended < 2) runner.Submit(std::span(&jobs[next++], 1));
    const auto finished = runner.Wait(60);
    ASSERT_FALSE(finished.empty());
    for (const FinishedJob& job : finished) {
      EXPECT_TRUE(job.ok()) << job.reason;
      ++num_ends.at(static_cast<std::size_t>(job.id));
    }
    ended += finished.size();
  }
  EXPECT_THAT(num_ends, Each(1));
}

TEST(ExitStatus, OnlyThoseAboveByASignalsNumberAreOfASignal) {
  EXPECT_EQ(SignalOf(137), 9);
  EXPECT_EQ(SignalOf(128), std::nullopt);
  EXPECT_EQ(SignalOf(3), std::nullopt);
  EXPECT_EQ(SignalOf(255), std::nullopt);  // as ssh and mpirun exit
}

}  // namespace local_runner_test
}  // namespace talus::runners
