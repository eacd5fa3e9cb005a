// A campaign that a talus before the journal's schema 3 began (tests/data/journal_v2) goes on as it
// would have there: 2 trials of noise, 8 of a Sobol sequence and 4 that confirm, simulated then;
// left as if the process had ended just before the result was written.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/journal/database.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

class OldCampaign : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder());
    for (const char* file : {"journal.sqlite", "campaign.json", "aehp.png"}) {
      fs::copy_file(data() / file, folder() / file);
    }
  }
  static fs::path data() { return fs::path(TALUS_SOURCE_DIR) / "tests" / "data" / "journal_v2"; }
  fs::path folder() const { return scratch_.path() / "run"; }

  std::vector<journal::TrialRecord> Trials() const {
    return journal::Journal::OpenReadOnly(journal::JournalPath(folder())).Trials();
  }
  // As that program exported them, one a line, up to and with the parameters.
  static std::vector<std::string> ExpectedLines() {
    std::istringstream file(base::ReadFile(data() / "expected_trials.csv"));
    std::vector<std::string> lines;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::size_t end = 0;
      for (int comma = 0; comma < 8; ++comma) end = line.find(',', end) + 1;
      lines.push_back(line.substr(0, end - 1));
    }
    return lines;
  }
  static std::string LineOf(const journal::TrialRecord& t) {
    std::ostringstream line;
    line.precision(17);
    line << t.id << ',' << base::NameOf(t.kind) << ',' << t.origin << ',' << base::NameOf(t.status)
         << ',' << t.seed << ',' << t.scale_factor;
    return line.str();
  }
  static nlohmann::json Json(const fs::path& path) {
    return nlohmann::json::parse(base::ReadFile(path));
  }
  ScratchFolder scratch_;
};

TEST_F(OldCampaign, ItsEndIsWhatThatProgramSaid) {
  EXPECT_EQ(RunFake(folder(), {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials().size(), 14u);  // none was simulated again
  // As that program wrote it, in today's names.
  const nlohmann::json expected = nlohmann::json::parse(
      ResultText(ParseResult(base::ReadFile(data() / "expected_result.json"))));
  const nlohmann::json result = Json(folder() / "result.json");
  for (const char* key : {"stop_reason", "objective", "parameters", "predicted_objective",
                          "noise_sd", "replicates_sd", "confirmed", "model", "conditions"}) {
    EXPECT_EQ(result[key], expected[key]) << key;
  }
}

TEST_F(OldCampaign, ItsSearchGoesOnWithTheSameSetsAndSeeds) {
  journal::Database(journal::JournalPath(folder()), journal::Database::Mode::kReadWrite)
      .Execute(
          "DELETE FROM profiles WHERE trial > 6; DELETE FROM metrics WHERE trial > 6;"
          "DELETE FROM points WHERE trial > 6; DELETE FROM trials WHERE id > 6");
  EXPECT_EQ(RunFake(folder(), {}), CampaignEnd::kFinished);
  const std::vector<journal::TrialRecord> trials = Trials();
  const std::vector<std::string> expected = ExpectedLines();
  ASSERT_EQ(trials.size(), expected.size());
  for (std::size_t i = 0; i < 10; ++i) {  // which sets are confirmed depends on the heaps
    EXPECT_EQ(expected[i].rfind(LineOf(trials[i]) + ",", 0), 0u) << expected[i];
    const std::string values = expected[i].substr(LineOf(trials[i]).size() + 1);
    EXPECT_EQ(std::stod(values), trials[i].native[0]);
    EXPECT_EQ(std::stod(values.substr(values.find(',') + 1)), trials[i].native[1]);
    EXPECT_EQ(trials[i].experiment, 0);
  }
}

TEST_F(OldCampaign, ItsDamagedJournalIsMadeAnewFromWhatThatProgramKept) {
  fs::resize_file(journal::JournalPath(folder()), 5000);
  EXPECT_EQ(RunFake(folder(), {}), CampaignEnd::kFinished);
  const journal::CampaignRecord record =
      journal::Journal::OpenReadOnly(journal::JournalPath(folder())).Campaign();
  ASSERT_EQ(record.experiments.size(), 1u);
  EXPECT_EQ(record.experiments[0].aehp_png, base::ReadFile(data() / "aehp.png"));
  EXPECT_NEAR(record.experiments[0].nebp_px, 797.6, 1e-9);
  EXPECT_EQ(Trials().size(), 14u);
}

}  // namespace
}  // namespace talus::campaign
