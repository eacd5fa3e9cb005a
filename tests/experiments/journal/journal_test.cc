#include "experiments/journal/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "experiments/journal/checksums.h"
#include "experiments/journal/database.h"
#include "experiments/journal/schema.h"
#include "tests/error_in.h"

namespace talus::journal {
namespace journal_test {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

class JournalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("talus_journal_" + std::to_string(::getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static CampaignRecord Campaign() {
    return {.name = "test",
            .spec_path = "/spec.json",
            .spec_text = "{}",
            .spec_json = "{}",
            .spec_hash = "0123",
            .talus_version = "0.1.0",
            .created_utc = UtcNow(),
            .objective = "sad",
            .parameters =
                {{.name = "sliding_friction", .low = 0, .high = 1, .scale = "linear", .unit = ""},
                 {.name = "surface_energy",
                  .low = 1e-6,
                  .high = 1e-4,
                  .scale = "log",
                  .unit = "J/m^2"}},
            .experiments = {Experiment("heap", 33), Experiment("wide plate", 12)}};
  }
  static ExperimentRecord Experiment(const std::string& name, double angle) {
    return {.name = name,
            .reference = {{.name = "repose_angle_2_mean_deg",
                           .value = angle,
                           .unit = "deg",
                           .undefined = ""}},
            .aehp_png = std::string("\0PNG", 4),
            .aehp_sd_png = "",
            .frame_json = "{}",
            .nebp_px = 12,
            .noise_mm2 = 0.5,
            .runs = {{.name = "1", .png = name + " one"}, {.name = "2", .png = name + " two"}},
            .scalars = {{.name = "mass_fallen_kg", .value = 2e-5, .standard_error = 1e-6}}};
  }
  static TrialRecord Trial(std::int64_t id) {
    TrialRecord trial;
    trial.id = id;
    trial.unit = {0.25, 0.5};
    trial.native = {0.25, 1e-5};
    trial.seed = 100 + id;
    trial.due = 0.1 * static_cast<double>(id);
    trial.experiment = static_cast<int>(id % 2);
    trial.started_utc = UtcNow();
    return trial;
  }
  static void StartTrial(Journal& journal, std::int64_t id) {
    const TrialRecord trial = Trial(id);
    journal.Start({&trial, 1});
  }
  static void FinishAsOk(Journal& journal, TrialRecord trial, double sad) {
    trial.status = TrialStatus::kOk;
    trial.metrics = {{.name = "sad_mm2", .value = sad, .unit = "mm2", .undefined = ""},
                     {.name = "repose_angle_2_mean_deg",
                      .value = std::nan(""),
                      .unit = "deg",
                      .undefined = "the heap overhangs"}};
    journal.Finish(trial, "image");
  }

  std::filesystem::path folder_;
  std::filesystem::path File() const { return JournalPath(folder_); }
};

TEST_F(JournalTest, OneOfAnotherVersionIsRefused) {
  for (const int version : {kSchemaVersion - 1, kSchemaVersion + 1}) {
    std::filesystem::remove(File());
    { Journal::Create(File(), Campaign()); }
    Database(File(), Database::Mode::kReadWrite)
        .Execute("PRAGMA user_version = " + std::to_string(version));
    for (const auto open : {&Journal::Open, &Journal::OpenReadOnly}) {
      try {
        open(File());
        ADD_FAILURE() << "schema " << version << " was opened";
      } catch (const base::ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("is of schema " + std::to_string(version)),
                  std::string::npos)
            << error.what();
      }
    }
  }
}

// A kill between the making of the file and the writing of the campaign leaves it.
TEST_F(JournalTest, AnEmptyOneIsSaidToHoldNoCampaign) {
  { std::ofstream empty(File()); }
  for (const auto open : {&Journal::Open, &Journal::OpenReadOnly}) {
    EXPECT_THAT(ErrorIn<base::Error>([&] { open(File()); }),
                HasSubstr("holds no campaign yet; `talus resume`"));
  }
}

// In SQLite's words alone nobody knew that it can be mended.
TEST_F(JournalTest, ATruncatedOneIsSaidToBeRepairable) {
  { Journal::Create(File(), Campaign()); }
  std::filesystem::resize_file(File(), std::filesystem::file_size(File()) / 2);
  EXPECT_THAT(ErrorIn<base::Error>([&] { Journal::OpenReadOnly(File()); }),
              AllOf(HasSubstr("is damaged"), HasSubstr("`talus resume` repairs it")));
}

TEST_F(JournalTest, HoldsWhatItWasGivenAndReadsItWhileItIsWritten) {
  Journal journal = Journal::Create(File(), Campaign());
  StartTrial(journal, 1);
  StartTrial(journal, 2);
  FinishAsOk(journal, Trial(2), 1.5);
  TrialRecord waits = Trial(1);
  waits.duration_s = 7;
  waits.cpu_s = 6;
  waits.host = "node";
  journal.NoteEnd(waits);
  journal.AddEvent("warning", 2, "text");

  Journal reader = Journal::OpenReadOnly(File());  // `journal` is still open
  const auto trials = reader.Trials();
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].status, TrialStatus::kRunning);
  EXPECT_EQ(trials[1].status, TrialStatus::kOk);
  EXPECT_EQ(trials[0].duration_s, 7);
  EXPECT_EQ(trials[0].cpu_s, 6);
  EXPECT_EQ(trials[0].host, "node");
  EXPECT_EQ(trials[0].experiment, 1);
  EXPECT_EQ(trials[1].experiment, 0);
  EXPECT_EQ(trials[1].due, Trial(2).due);
  EXPECT_EQ(trials[1].finish_order, 1);
  EXPECT_EQ(trials[1].native, (std::vector<double>{0.25, 1e-5}));
  EXPECT_EQ(trials[1].Metric("sad_mm2"), 1.5);
  EXPECT_EQ(trials[1].Metric("repose_angle_2_mean_deg"), std::nullopt);
  EXPECT_EQ(trials[1].metrics[0].undefined, "the heap overhangs");
  EXPECT_EQ(reader.ProfilePng(2), "image");
  EXPECT_EQ(reader.ProfilePng(1), "");
  EXPECT_EQ(Database(File(), Database::Mode::kReadOnly).Number("SELECT trial FROM events"), 2);
  const CampaignRecord campaign = reader.Campaign();
  ASSERT_EQ(campaign.experiments.size(), 2u);
  EXPECT_EQ(campaign.experiments[0].aehp_png.size(), 4u);  // a zero byte does not end it
  EXPECT_EQ(campaign.experiments[1].name, "wide plate");
  EXPECT_EQ(campaign.experiments[1].runs.at(1).png, "wide plate two");
  EXPECT_EQ(campaign.experiments[1].scalars.at(0).standard_error, 1e-6);
  EXPECT_EQ(campaign.parameters.at(1).unit, "J/m^2");
  EXPECT_EQ(campaign.experiments[0].noise_mm2, 0.5);
  EXPECT_EQ(campaign.spec_path, "/spec.json");
  EXPECT_EQ(campaign.experiments[0].reference.at(0).value, 33);
  EXPECT_EQ(campaign.experiments[1].reference.at(0).value, 12);
}

TEST_F(JournalTest, IsReadableWithSqliteWithUnitsInTheNamesOfTheColumns) {
  Journal journal = Journal::Create(File(), Campaign());
  StartTrial(journal, 1);
  FinishAsOk(journal, Trial(1), 1.5);
  Database database(File(), Database::Mode::kReadOnly);
  Statement row = database.Prepare(
      "SELECT sliding_friction, surface_energy_J_per_m2, sad_mm2, repose_angle_2_mean_deg, "
      "duration_s FROM "
      "results");
  ASSERT_TRUE(row.Step());
  EXPECT_EQ(row.Real(1), 1e-5);
  EXPECT_EQ(row.Real(2), 1.5);
  EXPECT_TRUE(std::isnan(row.Real(3)));
}

// A sum that began with what is not known stayed so, and no budget saw the trial.
TEST_F(JournalTest, ATrialThatRunsHasTakenNothingSoFar) {
  Journal journal = Journal::Create(File(), Campaign());
  StartTrial(journal, 1);
  const std::vector<TrialRecord> trials = journal.Trials();
  EXPECT_EQ(trials.at(0).duration_s, 0);
  EXPECT_EQ(trials.at(0).cpu_s, 0);
}

TEST_F(JournalTest, FinishedTrialsKeepTheirOrder) {
  {
    Journal journal = Journal::Create(File(), Campaign());
    for (int id = 1; id <= 3; ++id) StartTrial(journal, id);
    FinishAsOk(journal, Trial(3), 1);
    FinishAsOk(journal, Trial(1), 2);
  }
  Journal again = Journal::Open(File());
  const auto trials = again.Trials();
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].finish_order, 2);
  EXPECT_EQ(trials[1].finish_order, 0);
  EXPECT_EQ(trials[2].finish_order, 1);
}

// Else a process that is killed in between leaves a test without the trials it could have had.
TEST_F(JournalTest, AnExperimentAndTheTrialsItTakesOverAreThereTogetherOrNotAtAll) {
  Journal journal = Journal::Create(File(), Campaign());
  const TrialRecord first[] = {Trial(1)};
  journal.Start(first);
  const TrialRecord again[] = {Trial(2), Trial(1)};
  EXPECT_THROW(journal.AddExperiment(Experiment("drum", 40), "{\"new\": 1}", again), base::Error);
  EXPECT_EQ(journal.Campaign().experiments.size(), 2u);
  EXPECT_EQ(journal.Campaign().spec_json, "{}");
  EXPECT_EQ(journal.Trials().size(), 1u);
  const TrialRecord further[] = {Trial(2), Trial(3)};
  journal.SetProgress({.state = CampaignState::kFinished, .result_json = "{}"});
  journal.AddExperiment(Experiment("drum", 40), "{\"new\": 1}", further);
  EXPECT_EQ(journal.Progress().result_json, "");  // it knows nothing of the new one
  EXPECT_EQ(journal.Campaign().experiments.size(), 3u);
  EXPECT_EQ(journal.Trials().size(), 3u);
}

// What another program holds was taken for damaged, and made anew without its events.
TEST_F(JournalTest, HeldByAnotherProgramIsNotDamaged) {
  Journal journal = Journal::Create(File(), Campaign());
  Database other(File(), Database::Mode::kReadWrite);
  other.Execute("BEGIN IMMEDIATE");
  const std::string error = ErrorIn<base::ConfigError>([&] { journal.SetProgress({}); });
  EXPECT_THAT(error, ::testing::HasSubstr("another program holds it"));
}

TEST_F(JournalTest, KilledWhileWritingLosesNothingThatWasFinished) {
  Journal::Create(File(), Campaign());
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    Journal journal = Journal::Open(File());
    for (int id = 1;; ++id) {
      StartTrial(journal, id);
      FinishAsOk(journal, Trial(id), id);
      (void)!::write(told[1], &id, sizeof id);
    }
  }
  int last = 0;
  while (last < 20 && ::read(told[0], &last, sizeof last) == sizeof last) {
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(told[1]);
  while (::read(told[0], &last, sizeof last) == sizeof last) {
  }
  ::close(told[0]);
  const auto trials = Journal::Open(File()).Trials();
  ASSERT_GE(trials.size(), static_cast<std::size_t>(last));
  for (int i = 0; i < last; ++i)
    EXPECT_EQ(trials[static_cast<std::size_t>(i)].Metric("sad_mm2"), i + 1);
}

TEST_F(JournalTest, DamageIsNoticed) {
  {
    Journal journal = Journal::Create(File(), Campaign());
    for (int id = 1; id <= 40; ++id) {
      StartTrial(journal, id);
      FinishAsOk(journal, Trial(id), 1);
    }
  }
  std::filesystem::resize_file(File(), std::filesystem::file_size(File()) / 2);
  EXPECT_THROW(Journal::Open(File()), base::Error);
  std::ofstream(folder_ / "text")
      << "not a database, but longer than the header of one is, so that "
         "nothing but its content tells it from a journal........";
  EXPECT_THROW(Journal::Open(folder_ / "text"), base::Error);
}

TEST_F(JournalTest, AnImageThatDoesNotMatchItsChecksumIsNotReturned) {
  Journal journal = Journal::Create(File(), Campaign());
  StartTrial(journal, 1);
  FinishAsOk(journal, Trial(1), 1);
  Database(File(), Database::Mode::kReadWrite)
      .Execute("UPDATE profiles SET png = x'00' WHERE trial = 1");
  EXPECT_EQ(journal.ProfilePng(1), "");
}

TEST_F(JournalTest, IsNotMadeTwiceNorReadWhereItIsNot) {
  { Journal::Create(File(), Campaign()); }
  EXPECT_THROW(Journal::Create(File(), Campaign()), base::ConfigError);
  EXPECT_THROW(Journal::OpenReadOnly(folder_ / "absent"), base::ConfigError);
}

// The SQL of every statement that any connection of this process runs while this lives.
class StatementTrace {
 public:
  StatementTrace() {
    statements_.clear();
    ::sqlite3_auto_extension(reinterpret_cast<void (*)()>(&Attach));
  }
  ~StatementTrace() { ::sqlite3_cancel_auto_extension(reinterpret_cast<void (*)()>(&Attach)); }
  static const std::vector<std::string>& statements() { return statements_; }

 private:
  static int Attach(sqlite3* database, const char**, const sqlite3_api_routines*) {
    return ::sqlite3_trace_v2(database, SQLITE_TRACE_STMT, &Note, nullptr);
  }
  static int Note(unsigned, void*, void*, void* sql) {
    statements_.emplace_back(static_cast<const char*>(sql));
    return 0;
  }
  static inline std::vector<std::string> statements_;
};

// One query a trial, or images read along, would take seconds for ten thousand trials.
TEST_F(JournalTest, ManyTrialsAreReadByAsManyStatementsAsFewAndWithoutTheirImages) {
  std::size_t num_statements[2] = {};
  for (const int i : {0, 1}) {
    const int num_trials = i == 0 ? 2 : 1000;
    std::filesystem::remove(File());
    { Journal::Create(File(), Campaign()); }
    {
      Database database(File(), Database::Mode::kReadWrite);
      database.Execute("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < " +
                       std::to_string(num_trials) +
                       ") INSERT INTO trials SELECT i, 'search', i, i, 'model', 'sad', i, 1, 'ok', "
                       "'', 1, i, i, '', '', 1, 1, 1, 1, '', '', 0 FROM n;"
                       "INSERT INTO points SELECT t.id, p.position, 0.5, 0.5 FROM trials t, "
                       "parameters p;"
                       "INSERT INTO metrics SELECT id, m.column1, 1, '', '' FROM trials, (VALUES "
                       "('sad'), ('rmse'), ('aor1'), ('aor2'), ('aor3')) m;"
                       "INSERT INTO profiles SELECT id, zeroblob(80), '' FROM trials;");
      SealAll(database);
    }
    const StatementTrace trace;
    const auto trials = Journal::OpenReadOnly(File()).Trials();
    ASSERT_EQ(trials.size(), static_cast<std::size_t>(num_trials));
    EXPECT_EQ(trials.back().unit.size(), 2u);
    EXPECT_EQ(trials.back().metrics.size(), 5u);
    num_statements[i] = trace.statements().size();
    EXPECT_THAT(trace.statements(), Each(Not(HasSubstr("profiles"))));
  }
  EXPECT_GT(num_statements[0], 0u);
  EXPECT_EQ(num_statements[1], num_statements[0]);
}

}  // namespace journal_test
}  // namespace talus::journal
