// What may happen to a campaign from outside: after `resume` it has the trials, the numbers and
// the recommendation of one that nothing has happened to.
#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <pwd.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cmath>

#include "base/error.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/system/jumping_clock.h"
#include "tests/system/session.h"

namespace talus::campaign {
namespace campaign_faults_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr const char* kSpec = R"(,
  "strategy": {"kind": "sobol"}, "budget": {"simulations": 20}, "noise": {"replicates": 2},
  "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)";

class CampaignFaults : public CampaignFixture {
 protected:
  fs::path Begin(const std::string& name) const { return CampaignFixture::Begin(kSpec, name); }
  // What an undisturbed campaign comes to.
  struct Calm {
    std::string table;
    std::string recommended;
  };
  Calm RunCalm() {
    const fs::path folder = Finished(kSpec, {}, "calm");
    return {TrialTable(folder), Recommended(folder)};
  }
  // All of the result but what it cost, which no two runs share: recommended set, ranges,
  // candidates.
  static std::string Recommended(const fs::path& folder) {
    Answer result = Result(folder);
    result.cost = {};
    return AnswerJson(result);
  }
  static std::size_t NumTrials(const fs::path& folder) { return Trials(folder).size(); }
  void ExpectCalm(const fs::path& folder, const Calm& calm) {
    EXPECT_EQ(TrialTable(folder), calm.table);
    EXPECT_EQ(Recommended(folder), calm.recommended);
  }
};

TEST_F(CampaignFaults, KilledAtManyMoments) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("killed");
  base::Random random(1, base::Stream("moments of death"));
  int kills = 0;
  for (int session = 0; session < 200; ++session) {
    // From the opening of the journal to several trials on; longer and longer, so that a slow
    // machine gets on too, by a factor, so that it soon does.
    const double lifetime = random.Uniform(0.005, 0.05 * std::pow(1.25, session));
    const int end = WaitForExit(StartSession(folder, {.sleep = 0.01}, {.lifetime = lifetime}));
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
  const pid_t child = StartSession(folder, {.hang_at = 2});
  while (NumTrials(folder) < 2) Pause(0.02);
  ::kill(child, SIGTERM);
  EXPECT_EQ(WaitForExit(child), static_cast<int>(CampaignEnd::kInterrupted));
  EXPECT_EQ(journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Progress().state,
            journal::CampaignState::kInterrupted);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, CtrlCDrainsSoThatNothingRunsAfterwards) {
  const fs::path folder = Begin("drained");
  const pid_t child = StartSession(folder, {.sleep = 0.5});
  while (NumTrials(folder) < 2) Pause(0.02);
  ::kill(child, SIGINT);
  EXPECT_EQ(WaitForExit(child), static_cast<int>(CampaignEnd::kInterrupted));
  for (const journal::TrialRecord& t :
       journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Trials()) {
    EXPECT_EQ(t.status, journal::TrialStatus::kOk) << t.id;
  }
}

// A file may not grow beyond the limit: the same error as a full disk for everything we write.
TEST_F(CampaignFaults, FullDiskStopsTheCampaignAndIsNotTakenForAFailedTrial) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("full");
  EXPECT_EQ(WaitForExit(StartSession(folder, {}, {.largest_file = 120'000})), kThrew);
  const std::size_t before = NumTrials(folder);
  EXPECT_LT(before, 22u);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

// A file system of a megabyte that the campaign fills, and that is enlarged afterwards.
class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& path) : path_(path) {
    fs::create_directories(path);
    mounted_ = ::mount("tmpfs", path.c_str(), "tmpfs", 0, "size=1m") == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount(path_.c_str());
  }
  bool mounted() const { return mounted_; }
  bool Enlarge() const {
    return ::mount("tmpfs", path_.c_str(), "tmpfs", MS_REMOUNT, "size=64m") == 0;
  }

 private:
  fs::path path_;
  bool mounted_ = false;
};

TEST_F(CampaignFaults, FullFileSystemStopsTheCampaignAndResumeGoesOnWhenThereIsRoom) {
  const Calm calm = RunCalm();
  const SmallDisk disk(scratch_.path() / "disk");
  if (!disk.mounted()) GTEST_SKIP() << "mounting a small file system needs root";
  const fs::path folder = Begin("disk/full");
  EXPECT_EQ(WaitForExit(StartSession(folder)), kThrew);
  EXPECT_LT(NumTrials(folder), 22u);
  for (const journal::TrialRecord& trial : Trials(folder))
    EXPECT_NE(trial.status, journal::TrialStatus::kFailed);
  ASSERT_TRUE(disk.Enlarge());
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

// Root may write everywhere, so that under root the session gives up its rights first.
TEST_F(CampaignFaults, ReadOnlyFolderIsSaidAndChangesNothing) {
  const fs::path folder = Begin("read_only");
  const auto before = fs::last_write_time(journal::JournalPath(folder));
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                              fs::perms::others_exec);
  const pid_t child = ::fork();
  if (child == 0) {
    const passwd* nobody = ::getpwnam("nobody");
    const bool root = ::geteuid() == 0;
    if (root && (nobody == nullptr || ::setgroups(0, nullptr) != 0 ||
                 ::setgid(nobody->pw_gid) != 0 || ::setuid(nobody->pw_uid) != 0)) {
      ::_exit(1);
    }
    try {
      RunFake(folder, {});
    } catch (const base::Error& error) {
      ::_exit(std::string(error.what()).find("cannot be written") == std::string::npos ? 2
                                                                                       : kThrew);
    }
    ::_exit(3);
  }
  EXPECT_EQ(WaitForExit(child), kThrew);
  fs::permissions(folder, fs::perms::owner_all);
  EXPECT_EQ(NumTrials(folder), 0u);
  EXPECT_EQ(fs::last_write_time(journal::JournalPath(folder)), before);
}

// The wall clock may be set while a campaign runs; only the times that people read may follow it.
class ClockChange : public CampaignFaults {
 protected:
  void TearDown() override { Set(0, false); }
  static void Set(long jump, bool alternates) {
    clock_jump = jump;
    clock_alternates = alternates;
  }
};

TEST_F(ClockChange, ChangesNeitherTrialsNorResultNorEndsByTheTimeBudget) {
  std::string spec = kSpec;
  const std::string budget = R"("simulations": 20)";
  spec.replace(spec.find(budget), budget.size(), budget + R"(, "wall_clock": "1 h")");
  const fs::path undisturbed = CampaignFixture::Begin(spec, "calm");
  RunFake(undisturbed, {});
  const Calm calm{TrialTable(undisturbed), Recommended(undisturbed)};
  constexpr long kYear = 365L * 86400;
  for (const long jump : {kYear, -kYear}) {
    const fs::path folder = CampaignFixture::Begin(spec, jump > 0 ? "forwards" : "backwards");
    const pid_t child = StartSession(folder, {.hang_at = 6});
    while (NumTrials(folder) < 6) Pause(0.02);
    ::kill(child, SIGKILL);
    WaitForExit(child);
    Set(jump, false);  // while the campaign lies idle
    EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
    ExpectCalm(folder, calm);
    const int year = std::stoi(Trials(folder).back().finished_utc);
    const int year_before = std::stoi(Trials(folder).front().finished_utc);
    EXPECT_NEAR(year - year_before, jump > 0 ? 1 : -1, 1) << "the clock was not set";
    EXPECT_NE(year, year_before) << "the clock was not set";
    EXPECT_LT(journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Progress().elapsed_s,
              3600);
    Set(0, false);
  }
}

TEST_F(ClockChange, EvenBetweenAnyTwoReadings) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("restless");
  clock_readings = 0;
  Set(86400, true);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  Set(0, false);
  EXPECT_GT(clock_readings, 50);  // some 75
  ExpectCalm(folder, calm);
  // What is measured is measured by a clock that only goes forwards.
  for (const journal::TrialRecord& trial : Trials(folder)) {
    EXPECT_GE(trial.duration_s, 0) << trial.id;
    EXPECT_LT(trial.duration_s, 3600) << trial.id;
  }
}

TEST_F(CampaignFaults, ATruncatedJournalIsMadeAnewFromTheTrials) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("truncated");
  const pid_t child = StartSession(folder, {.hang_at = 8});
  while (NumTrials(folder) < 8) Pause(0.02);
  ::kill(child, SIGKILL);
  WaitForExit(child);
  { journal::Journal::Open(journal::JournalPath(folder)); }  // moves its log into the file
  fs::resize_file(journal::JournalPath(folder), fs::file_size(journal::JournalPath(folder)) / 2);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
  EXPECT_TRUE(fs::exists(folder / "journal.sqlite.damaged1"));
}

TEST_F(CampaignFaults, ALostLogOfTheJournalLosesNoTrialAndRunsNoneTwice) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("lost_log");
  const pid_t child = StartSession(folder, {.hang_at = 8});
  while (NumTrials(folder) < 8) Pause(0.02);
  ::kill(child, SIGKILL);
  WaitForExit(child);
  fs::resize_file(journal::JournalPath(folder).string() + "-wal",
                  fs::file_size(journal::JournalPath(folder).string() + "-wal") / 2);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

// As when a network file system loses some: what the journal has does not need them.
TEST_F(CampaignFaults, LostFoldersOfTrialsAreNotMissed) {
  const Calm calm = RunCalm();
  for (const bool journal_too : {false, true}) {
    const fs::path folder = Begin(journal_too ? "lost_both" : "lost");
    const pid_t child = StartSession(folder, {.hang_at = 8});
    while (NumTrials(folder) < 8) Pause(0.02);
    ::kill(child, SIGKILL);
    WaitForExit(child);
    for (const char* trial : {"0003", "0005", "0008"}) fs::remove_all(folder / "trials" / trial);
    if (journal_too) fs::resize_file(journal::JournalPath(folder), 100);
    EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
    ExpectCalm(folder, calm);
  }
}

// It was told to the optimiser as a failure of the parameters.
TEST_F(CampaignFaults, AFolderThatVanishesUnderItsTrialStopsTheCampaign) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("vanished");
  EXPECT_THAT([&] { RunFake(folder, {.vanish = true}); },
              ThrowsMessage<base::Error>(HasSubstr("0001: has vanished while its trial ran")));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

// On a node's own disk, say: the campaign's folder has room.
TEST_F(CampaignFaults, ATrialThatFindsTheDiskFullStopsTheCampaign) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("disk_full");
  EXPECT_THAT([&] { RunFake(folder, {.disk_full = true}); },
              ThrowsMessage<base::Unwritten>(
                  AllOf(HasSubstr("trial 1: "), HasSubstr("No space left on device"))));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ExpectCalm(folder, calm);
}

TEST_F(CampaignFaults, TruncatedImagesOfFinishedTrialsDoNotMatter) {
  const Calm calm = RunCalm();
  const fs::path folder = Begin("images");
  const pid_t child = StartSession(folder, {.hang_at = 8});
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

}  // namespace campaign_faults_test
}  // namespace talus::campaign
