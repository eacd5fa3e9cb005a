// The Slurm runner on a real, one-node Slurm (tests/system/slurm/one_node_cluster).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>

#include "base/files/file.h"
#include "experiments/runners/slurm_runner.h"
#include "experiments/runners/tool.h"

namespace talus::runners {
namespace slurm_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

constexpr const char* kCluster = TALUS_SOURCE_DIR "/tests/system/slurm/one_node_cluster";

class SlurmTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    root_ = fs::temp_directory_path() / ("talus_slurm_" + std::to_string(::getpid()));
    fs::create_directories(root_);
    const ToolResult started =
        RunTool({kCluster, "start", root_ / "cluster"}, {.output_file = root_ / "start.txt"});
    status_ = started.status;
    message_ = started.errors;
    ::setenv("SLURM_CONF", (root_ / "cluster/slurm.conf").c_str(), 1);
    if (status_ != 0) return;
    SlurmOptions options;
    options.time = 1;
    options.partition = "urgent";  // which nothing preempts
    long_runner_ = std::make_unique<SlurmRunner>(options, root_ / "long");
    const Job job = Shell(root_ / "long", 1, "exec sleep 300");
    long_runner_->Submit({&job, 1});
  }
  static void TearDownTestSuite() {
    long_runner_.reset();
    if (status_ != 77) RunTool({kCluster, "stop", root_ / "cluster"});
    fs::remove_all(root_);
  }
  void SetUp() override {
    constexpr int kSkip = 77;
    if (status_ == kSkip) GTEST_SKIP() << message_;
    ASSERT_EQ(status_, 0) << message_;
    folder_ = root_ / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder_);
  }

  Job Shell(std::int64_t id, const std::string& script) { return Shell(folder_, id, script); }
  static Job Shell(const fs::path& root, std::int64_t id, const std::string& script) {
    Job job;
    job.id = id;
    job.folder = root / "trials" / std::to_string(id);
    fs::create_directories(job.folder);
    job.command = {"sh", "-c", script};
    return job;
  }
  static std::vector<FinishedJob> Finish(SlurmRunner& runner, std::size_t count, double seconds) {
    std::vector<FinishedJob> all;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (all.size() < count && Clock::now() < end) {
      for (const FinishedJob& finished : runner.Wait(1)) all.push_back(finished);
    }
    std::sort(all.begin(), all.end(),
              [](const FinishedJob& a, const FinishedJob& b) { return a.id < b.id; });
    return all;
  }
  static std::string Read(const fs::path& path) {
    return fs::exists(path) ? base::ReadFile(path) : "";
  }
  // Until the job has begun to write.
  static void AwaitFile(const fs::path& path) {
    for (int i = 0; i < 300 && Read(path).empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ASSERT_FALSE(Read(path).empty()) << path;
  }
  static std::string Node() {
    const std::string name = RunTool({"hostname", "-s"}).output;
    return name.substr(0, name.find('\n'));
  }

  static inline fs::path root_;
  static inline std::unique_ptr<SlurmRunner> long_runner_;
  static inline int status_ = 0;
  static inline std::string message_;
  fs::path folder_;
};

TEST_F(SlurmTest, JobsEndInEveryWayThereIs) {
  SlurmOptions options;
  SlurmOptions small = options;
  small.memory = "60";
  SlurmRunner runner(options, folder_ / "campaign");
  SlurmRunner small_runner(small, folder_ / "small");
  const Job jobs[] = {Shell(1, "echo done; exit 0"), Shell(2, "exit 3"),
                      Shell(3, "talus-no-such"),     Shell(4, "echo $$ >pid; exec sleep 300"),
                      Shell(5, "exec sleep 300"),    Shell(6, "exec sleep 300")};
  const auto names = runner.Submit(jobs);
  // 300 MB where 60 MB were asked for; the test's cluster looks once a second.
  const Job greedy[] = {Shell(7,
                              "/usr/bin/python3 -c 'x = bytearray(300000000); import time; "
                              "time.sleep(60)'")};
  small_runner.Submit(greedy);
  AwaitFile(jobs[3].folder / "pid");
  ::kill(static_cast<pid_t>(std::stol(Read(jobs[3].folder / "pid"))), SIGKILL);
  RunTool({"scancel", names[4]});
  runner.Cancel(6);
  const auto finished = Finish(runner, 6, 40);
  ASSERT_EQ(finished.size(), 6u);
  EXPECT_TRUE(finished[0].ok()) << finished[0].reason;
  EXPECT_EQ(Read(jobs[0].folder / "log.txt"), "done\n");
  EXPECT_EQ(finished[1].exit_status, 3);
  EXPECT_EQ(finished[2].end, JobEnd::kNotStarted);
  EXPECT_EQ(finished[3].end, JobEnd::kPreempted);  // as on one machine: it is run again
  EXPECT_THAT(finished[3].reason, HasSubstr("signal 9"));
  EXPECT_EQ(finished[4].end, JobEnd::kCancelled);
  EXPECT_EQ(finished[5].end, JobEnd::kCancelled);
  const auto over = Finish(small_runner, 1, 40);
  ASSERT_EQ(over.size(), 1u);
  EXPECT_EQ(over[0].end, JobEnd::kOutOfMemory) << over[0].reason;
}

TEST_F(SlurmTest, PreemptedJobIsSubmittedAgain) {
  SlurmOptions options;
  options.partition = "cancel";  // where preempted jobs are ended, not requeued
  options.cores = 3;
  SlurmRunner runner(options, folder_ / "campaign");
  Job job = Shell(1, "echo run >>runs; [ $(wc -l <runs) -gt 1 ] || exec sleep 300");
  runner.Submit({&job, 1});
  AwaitFile(job.folder / "runs");
  RunTool({"sbatch", "--partition=urgent", "--cpus-per-task=3", "--output=/dev/null",
           "--wrap=sleep 1"});
  const auto finished = Finish(runner, 1, 40);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_TRUE(finished[0].ok()) << finished[0].reason;
  EXPECT_THAT(finished[0].reason, HasSubstr("submitted again 1 times: it was preempted"));
}

// Each of a few processes after the other is "killed" (leaves without a word) at another moment.
TEST_F(SlurmTest, KilledCampaignsJobsAreFoundAgainAndRunOnce) {
  const Job jobs[] = {Shell(1, "echo run >>runs"), Shell(2, "echo run >>runs; sleep 4"),
                      Shell(3, "echo run >>runs; sleep 4")};
  {
    SlurmRunner first({}, folder_ / "campaign");
    first.Submit(std::span(jobs).first(2));
    AwaitFile(jobs[0].folder / "runs");
  }
  {
    SlurmRunner second({}, folder_ / "campaign");
    EXPECT_TRUE(second.Adopt(jobs[0], ""));
    EXPECT_TRUE(second.Adopt(jobs[1], ""));
    EXPECT_FALSE(second.Adopt(jobs[2], ""));
    second.Submit(std::span(jobs).last(1));
  }
  // As if it had been killed before sbatch's answer was written.
  fs::remove(folder_ / "campaign/slurm/batch-000002.job");
  SlurmRunner third({}, folder_ / "campaign");
  for (const Job& job : jobs) EXPECT_TRUE(third.Adopt(job, ""));
  const auto finished = Finish(third, 3, 40);
  ASSERT_EQ(finished.size(), 3u);
  for (const FinishedJob& job : finished) EXPECT_TRUE(job.ok()) << job.reason;
  for (const Job& job : jobs) EXPECT_EQ(Read(job.folder / "runs"), "run\n");
}

// Slurm's shortest limit is a minute, and it looks every half minute: submitted before the first
// test, and over before the node goes down.
TEST_F(SlurmTest, JobOverItsTimeIsStopped) {
  const auto finished = Finish(*long_runner_, 1, 110);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, JobEnd::kTimeCap) << finished[0].reason;
}

TEST_F(SlurmTest, NodeFailureIsFollowedByAnotherRun) {
  SlurmOptions by_slurm;  // which requeues what --requeue allows
  SlurmOptions by_us;
  by_us.directives = {"--no-requeue"};
  SlurmRunner slurm_requeues(by_slurm, folder_ / "a");
  SlurmRunner we_requeue(by_us, folder_ / "b");
  Job first = Shell(1, "echo run >>runs; [ $(wc -l <runs) -gt 1 ] || exec sleep 300");
  Job second = Shell(2, first.command.back());
  const auto name = slurm_requeues.Submit({&first, 1}).front();
  we_requeue.Submit({&second, 1});
  AwaitFile(first.folder / "runs");
  AwaitFile(second.folder / "runs");
  RunTool({"scontrol", "update", "nodename=" + Node(), "state=down", "reason=test"});
  std::this_thread::sleep_for(std::chrono::seconds(1));
  RunTool({"scontrol", "update", "nodename=" + Node(), "state=resume"});
  // Slurm holds a requeued job back for two minutes; the test does not.
  RunTool({"scontrol", "update", "jobid=" + name, "StartTime=now"});
  const auto ours = Finish(we_requeue, 1, 40);
  ASSERT_EQ(ours.size(), 1u);
  EXPECT_TRUE(ours[0].ok()) << ours[0].reason;
  EXPECT_THAT(ours[0].reason, HasSubstr("submitted again 1 times: it lost its node (NODE_FAIL)"));
  const auto slurms = Finish(slurm_requeues, 1, 40);
  ASSERT_EQ(slurms.size(), 1u);
  EXPECT_TRUE(slurms[0].ok()) << slurms[0].reason;
  EXPECT_THAT(slurms[0].reason, HasSubstr("after Slurm had requeued it 1 times"));
  EXPECT_EQ(Read(first.folder / "runs"), "run\nrun\n");
  EXPECT_EQ(Read(second.folder / "runs"), "run\nrun\n");
}

}  // namespace slurm_test
}  // namespace talus::runners
