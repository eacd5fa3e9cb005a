// Bits turned over in what a campaign keeps: each is harmless, or noticed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_writer.h"
#include "base/random.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/journal/journal.h"
#include "imaging/formats/images/image_file.h"

namespace talus::campaign {
namespace bit_flip_test {

namespace fs = std::filesystem;

journal::CampaignRecord Campaign() {
  journal::CampaignRecord record;
  record.name = "flips";
  record.spec_text = "{\"budget\": {\"simulations\": 30}}";
  record.spec_json = record.spec_text;
  record.objective = "sad";
  record.parameters = {
      {.name = "sliding_friction", .low = 0, .high = 1, .scale = "linear", .unit = ""},
      {.name = "rolling_friction", .low = 0, .high = 1, .scale = "linear", .unit = ""}};
  journal::ExperimentRecord experiment;
  experiment.name = "heap";
  experiment.reference = {{.name = "nebp_px", .value = 1e4, .unit = "px", .undefined = ""}};
  experiment.aehp_png = std::string(400, 'p');
  experiment.frame_json = "{}";
  experiment.warnings = {
      {.kind = "blurred", .photo = "run01_view1.jpg", .value = 0.5, .text = std::string(400, 'w')}};
  record.experiments = {experiment};
  return record;
}

journal::TrialRecord Trial(std::int64_t id) {
  journal::TrialRecord trial;
  trial.id = id;
  trial.unit = {0.01 * static_cast<double>(id), 0.5};
  trial.native = trial.unit;
  trial.seed = 1000 + id;
  trial.started_utc = "2026-01-31T12:00:00Z";
  return trial;
}

void Finish(journal::Journal& journal, std::int64_t id) {
  journal::TrialRecord trial = Trial(id);
  trial.status = journal::TrialStatus::kOk;
  trial.duration_s = 1.5;
  trial.metrics = {
      {.name = "sad_mm2", .value = 1.0 / static_cast<double>(id), .unit = "mm2", .undefined = ""}};
  journal.Finish(trial, std::string(300, static_cast<char>('a' + id % 20)));
}

// All that an answer is made of.
std::string Content(journal::Journal& journal, bool with_profiles = true) {
  std::string content = base::ToJson(journal.Campaign()).dump() +
                        journal.Campaign().experiments.at(0).aehp_png +
                        journal.Progress().result_json + base::ToJson(journal.Trials()).dump();
  for (const journal::TrialRecord& trial : journal.Trials()) {
    if (with_profiles) content += journal.ProfilePng(trial.id);
  }
  return content;
}

class BitFlips : public testing::Test {
 protected:
  BitFlips() : folder_(fs::temp_directory_path() / ("talus_flips_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "copy");
  }
  ~BitFlips() override { fs::remove_all(folder_); }

  static std::string Flipped(std::string bytes, std::uint64_t round) {
    base::Random random(7, base::Stream("bit flips"), round);
    bytes[random.Below(bytes.size())] ^= static_cast<char>(1 << random.Below(8));
    return bytes;
  }

  fs::path folder_;
};

// Before, 5 of 100 flips were not noticed, and one changed the answer.
TEST_F(BitFlips, OfTheJournalAreHarmlessOrNoticed) {
  const fs::path path = journal::JournalPath(folder_);
  std::string good;
  {
    journal::Journal journal = journal::Journal::Create(path, Campaign());
    for (std::int64_t id = 1; id <= 12; ++id) {
      const journal::TrialRecord trial = Trial(id);
      journal.Start({&trial, 1});
      if (id < 12) Finish(journal, id);
    }
    good = Content(journal);
  }
  const std::string bytes = base::ReadFile(path);
  int noticed = 0;
  for (std::uint64_t round = 0; round < 1000; ++round) {
    const fs::path copy = journal::JournalPath(folder_ / "copy");
    for (const char* rest : {"-wal", "-shm"}) fs::remove(copy.string() + rest);
    base::WriteFileAtomically(copy, Flipped(bytes, round), base::Outlives::kProgram);
    try {
      journal::Journal journal = journal::Journal::Open(copy);
      // A profile has its own checksum: a damaged one is taken from the trial's folder.
      const bool whole = Content(journal) == good;
      if (!whole) {
        std::string without = Content(journal, false);
        journal::Journal original = journal::Journal::OpenReadOnly(path);
        ASSERT_EQ(without, Content(original, false)) << "round " << round;
      }
      noticed += whole ? 0 : 1;
    } catch (const base::Error&) {
      ++noticed;
    }
  }
  EXPECT_GT(noticed, 100);  // the others hit free space
  EXPECT_LT(noticed, 1000);
}

// The journal's own text of a table: rows and checksums stay whole, and a column has another name.
// It was said that there is "no such column: undefined".
TEST_F(BitFlips, OfTheTextOfATableAreNamedAsDamage) {
  const fs::path path = journal::JournalPath(folder_);
  { journal::Journal::Create(path, Campaign()); }
  std::string bytes = base::ReadFile(path);
  const std::size_t at =
      bytes.find("undefined TEXT NOT NULL,        -- why it is not defined\n  PRIMARY");
  ASSERT_NE(at, std::string::npos);
  bytes[at] ^= 1;
  base::WriteFileAtomically(path, bytes, base::Outlives::kProgram);
  for (const auto open : {&journal::Journal::Open, &journal::Journal::OpenReadOnly}) {
    try {
      open(path);
      ADD_FAILURE() << "it was opened";
    } catch (const base::Error& error) {
      EXPECT_THAT(error.what(),
                  testing::HasSubstr("is damaged: the table metrics is not as it was made"));
    }
  }
}

// SQLite takes a frame that does not match its checksum for the end of the log: the journal is then
// as it was after an earlier commit, and what is missing is found in the trials' folders.
TEST_F(BitFlips, OfTheLogLeaveAnEarlierStateOrAreNoticed) {
  const fs::path path = journal::JournalPath(folder_);
  journal::Journal journal = journal::Journal::Create(path, Campaign());
  const std::string first = Content(journal);
  std::set<std::string> states{first};
  for (std::int64_t id = 1; id <= 12; ++id) {
    const journal::TrialRecord trial = Trial(id);
    journal.Start({&trial, 1});
    states.insert(Content(journal));
    Finish(journal, id);
    states.insert(Content(journal));
  }
  const std::string log = base::ReadFile(path.string() + "-wal");
  ASSERT_GT(log.size(), 10000u);
  const std::string main = base::ReadFile(path);
  int later = 0;
  for (std::uint64_t round = 0; round < 300; ++round) {
    const fs::path copy = journal::JournalPath(folder_ / "copy");
    fs::remove(copy.string() + "-shm");
    base::WriteFileAtomically(copy, main, base::Outlives::kProgram);
    base::WriteFileAtomically(copy.string() + "-wal", Flipped(log, round),
                              base::Outlives::kProgram);
    try {
      journal::Journal flipped = journal::Journal::Open(copy);
      const std::string content = Content(flipped);
      EXPECT_TRUE(states.contains(content)) << "round " << round;
      later += content != first ? 1 : 0;
    } catch (const base::Error&) {
    }
  }
  EXPECT_GT(later, 30);  // the log is read as far as it is whole
}

// The journal is made anew from these; they had no checksum.
TEST_F(BitFlips, OfTheTrialsFoldersAreNoticed) {
  const CampaignFolder folder{folder_ / "copy"};
  fs::create_directories(folder.trial(1));
  KeepCampaign(folder, Campaign());
  KeepTrial(folder, Trial(1));
  std::string good;
  {
    journal::Journal journal = RebuildJournal(folder);
    good = Content(journal);
  }
  const auto flipped = [](const fs::path& file, const auto& check) {
    const std::string bytes = base::ReadFile(file);
    for (std::uint64_t round = 0; round < 200; ++round) {
      base::WriteFileAtomically(file, Flipped(bytes, round), base::Outlives::kProgram);
      SCOPED_TRACE(round);
      check();
    }
    base::WriteFileAtomically(file, bytes);
  };
  flipped(folder.campaign(), [&] { EXPECT_THROW(RebuildJournal(folder), base::Error); });
  flipped(folder.trial(1) / "trial.json", [&] {  // it is run again
    EXPECT_TRUE(RebuildJournal(folder).Trials().empty());
  });
  journal::Journal journal = RebuildJournal(folder);
  EXPECT_EQ(Content(journal), good);
}

// The journal is made anew from them too. PNG has a checksum for each of its parts.
TEST_F(BitFlips, OfAnImageAreHarmlessOrNoticed) {
  imaging::GrayImage image{.width = 40, .height = 30, .pixels = {}};
  for (int i = 0; i < image.width * image.height; ++i) {
    image.pixels.push_back(static_cast<std::uint8_t>(i * i));
  }
  const std::string good = imaging::EncodePng(image);
  int noticed = 0;
  for (std::uint64_t round = 0; round < 1000; ++round) {
    try {
      EXPECT_EQ(imaging::DecodeGrayImage(Flipped(good, round), "flipped"), image) << round;
    } catch (const base::Error&) {
      ++noticed;
    }
  }
  EXPECT_GT(noticed, 900);
}

// Without the image of an experiment its numbers alone were met.
TEST_F(BitFlips, ALostImageOfAnExperimentIsNoticed) {
  const CampaignFolder folder{folder_ / "copy"};
  KeepCampaign(folder, Campaign());
  fs::remove(folder.root / "aehp.png");
  EXPECT_THROW(RebuildJournal(folder), base::Error);
  EXPECT_FALSE(fs::exists(journal::JournalPath(folder.root)));
}

// A full disk, or a kill, while the journal was made left a database without tables, which was
// taken for another program's: neither `calibrate` nor `resume` went on.
TEST_F(BitFlips, AnEmptyDatabaseIsMadeAnew) {
  const CampaignFolder folder{folder_ / "copy"};
  KeepCampaign(folder, Campaign());
  const fs::path path = journal::JournalPath(folder.root);
  journal::Database(path, journal::Database::Mode::kCreate)
      .Execute("PRAGMA user_version = 0; VACUUM");
  ASSERT_GT(fs::file_size(path), 0u);
  try {
    journal::Journal::Open(path);
    ADD_FAILURE() << "it was opened";
  } catch (const base::ConfigError& error) {
    ADD_FAILURE() << error.what();
  } catch (const base::Error&) {  // upon which it is made anew
  }
  EXPECT_EQ(RebuildJournal(folder).Campaign().name, "flips");
}

// `resume` opened any database for writing, and made it one with a log, before it looked what it
// was.
TEST_F(BitFlips, AnotherProgramsDatabaseIsNotTouched) {
  const fs::path path = journal::JournalPath(folder_);
  {
    journal::Database database(path, journal::Database::Mode::kCreate);
    database.Execute("PRAGMA journal_mode = DELETE; CREATE TABLE thesis (chapter TEXT);");
  }
  const std::string before = base::ReadFile(path);
  EXPECT_THROW(journal::Journal::Open(path), base::ConfigError);
  EXPECT_EQ(base::ReadFile(path), before);
  EXPECT_FALSE(fs::exists(path.string() + "-wal"));
}

}  // namespace bit_flip_test
}  // namespace talus::campaign
