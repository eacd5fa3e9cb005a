// What may happen to a campaign from outside: after `resume` it has the trials, the numbers and
// the recommendation of one that nothing has happened to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "tests/experiments/fake_heap.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::experiments {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kSpec = R"(,
  "strategy": {"kind": "sobol"}, "budget": {"simulations": 20}, "noise": {"replicates": 2},
  "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)";

class CampaignFaults : public ::testing::Test {
 protected:
  fs::path Begin(const std::string& name) {
    const fs::path folder = scratch_.path() / name;
    BeginCampaign(WriteFakeSpec(scratch_.path() / "in", kSpec), folder);
    return folder;
  }
  // What an undisturbed campaign comes to.
  struct Calm {
    std::string table;
    std::string recommended;
  };
  Calm RunCalm() {
    const fs::path folder = Begin("calm");
    RunFake(folder, {});
    return {TrialTable(folder), Recommended(folder)};
  }
  static std::string Recommended(const fs::path& folder) {
    std::string text;
    for (const auto& p : ParseResult(base::ReadFile(folder / "result.json")).parameters) {
      text += p.name + " " + std::to_string(p.value) + "\n";
    }
    return text;
  }
  // A session in a process of its own, so that it can be killed. It exits with the CampaignEnd, or
  // with kThrew.
  static constexpr int kThrew = 77;
  static pid_t StartSession(const fs::path& folder, const FakeEngineOptions& engine = {},
                            rlim_t largest_file = RLIM_INFINITY) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    if (largest_file != RLIM_INFINITY) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{largest_file, largest_file};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    try {
      ::_exit(static_cast<int>(RunFake(folder, engine)));
    } catch (const std::exception&) {
      ::_exit(kThrew);
    }
  }
  static int WaitForExit(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  static void Pause(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }
  static std::size_t NumTrials(const fs::path& folder) {
    return Journal::OpenReadOnly(JournalPath(folder)).Trials().size();
  }
  void ExpectCalm(const fs::path& folder, const Calm& calm) {
    EXPECT_EQ(TrialTable(folder), calm.table);
    EXPECT_EQ(Recommended(folder), calm.recommended);
  }
  ScratchFolder scratch_;
};

TEST_F(CampaignFaults, KilledAtManyMoments) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("killed");
  base::Random random(1, base::Stream("moments of death"));
  int kills = 0;
  for (int session = 0; session < 200; ++session) {
    const pid_t child = StartSession(folder, {.sleep = 0.01});
    // From the opening of the journal to several trials on; longer and longer, so that a slow
    // machine gets on too.
    Pause(random.Uniform(0.005, 0.05 + 0.01 * session));
    ::kill(child, SIGKILL);
    const int end = WaitForExit(child);
    if (end == static_cast<int>(CampaignEnd::kFinished)) break;
    ASSERT_EQ(end, -SIGKILL);
    ++kills;
  }
  EXPECT_GE(kills, 4);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, KilledWorkersAreRunAgain) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("workers");
  EXPECT_EQ(RunFake(folder, {.die_once = true}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, SigtermStopsAtOnceAndResumeGoesOn) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("terminated");
  const pid_t child = StartSession(folder, {.sleep = 1});
  while (NumTrials(folder) < 2) Pause(0.02);
  ::kill(child, SIGTERM);
  EXPECT_EQ(WaitForExit(child), static_cast<int>(CampaignEnd::kInterrupted));
  EXPECT_EQ(Journal::OpenReadOnly(JournalPath(folder)).Progress().state, "interrupted");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, CtrlCDrainsSoThatNothingRunsAfterwards) {
  const fs::path folder = Begin("drained");
  const pid_t child = StartSession(folder, {.sleep = 0.5});
  while (NumTrials(folder) < 2) Pause(0.02);
  ::kill(child, SIGINT);
  EXPECT_EQ(WaitForExit(child), static_cast<int>(CampaignEnd::kInterrupted));
  for (const TrialRecord& t : Journal::OpenReadOnly(JournalPath(folder)).Trials()) {
    EXPECT_EQ(t.status, TrialStatus::kOk) << t.id;
  }
}

// A file may not grow beyond the limit: the same error as a full disk for everything we write.
TEST_F(CampaignFaults, FullDiskStopsTheCampaignAndIsNotTakenForAFailedTrial) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("full");
  EXPECT_EQ(WaitForExit(StartSession(folder, {}, 120'000)), kThrew);
  const std::size_t before = NumTrials(folder);
  EXPECT_LT(before, 22u);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, ReadOnlyFolderIsSaidAndChangesNothing) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const fs::path folder = Begin("read_only");
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(RunFake(folder, {}), base::Error);
  fs::permissions(folder, fs::perms::owner_all);
}

TEST_F(CampaignFaults, ATruncatedJournalIsMadeAnewFromTheTrials) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("truncated");
  const pid_t child = StartSession(folder, {.sleep = 0.05});
  while (NumTrials(folder) < 8) Pause(0.02);
  ::kill(child, SIGKILL);
  WaitForExit(child);
  { Journal::Open(JournalPath(folder)); }  // moves its log into the file
  fs::resize_file(JournalPath(folder), fs::file_size(JournalPath(folder)) / 2);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
  EXPECT_TRUE(fs::exists(folder / "journal.sqlite.damaged1"));
}

TEST_F(CampaignFaults, ALostLogOfTheJournalLosesNoTrialAndRunsNoneTwice) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("lost_log");
  const pid_t child = StartSession(folder, {.sleep = 0.05});
  while (NumTrials(folder) < 8) Pause(0.02);
  ::kill(child, SIGKILL);
  WaitForExit(child);
  fs::resize_file(JournalPath(folder).string() + "-wal",
                  fs::file_size(JournalPath(folder).string() + "-wal") / 2);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, TruncatedImagesOfFinishedTrialsDoNotMatter) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("images");
  const pid_t child = StartSession(folder, {.sleep = 0.05});
  while (NumTrials(folder) < 8) Pause(0.02);
  ::kill(child, SIGTERM);
  WaitForExit(child);
  for (const auto& trial : fs::directory_iterator(folder / "trials")) {
    const fs::path image = trial.path() / "profile.png";
    if (fs::exists(image)) fs::resize_file(image, fs::file_size(image) / 2);
  }
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

}  // namespace
}  // namespace talus::experiments
