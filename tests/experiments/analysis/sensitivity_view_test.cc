// What the report shows of `talus sensitivity`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files/file.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/views/folder_views.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace sensitivity_view_test {

using nlohmann::json;
using testing::HasSubstr;

// Restitution moves the rolling friction by 1.5 of its half range; what filling does is not told.
SensitivityTable Table(std::int64_t last_trial) {
  const auto shift = [](const char* name, double half_ranges, double error) {
    return AnswerShift{.parameter = name,
                       .from = 0.15,
                       .to = 0.11,
                       .standard_error = 0.01,
                       .half_ranges = half_ranges,
                       .half_ranges_error = error};
  };
  return {
      .scale_factor = 2,
      .last_trial = last_trial,
      .num_simulations = 20,
      .parameters = {{.name = "sliding_friction"}, {.name = "rolling_friction"}},
      .moves = {
          {.name = "restitution",
           .from = "0.9",
           .to = "0.6",
           .replicates = 4,
           .moves_still = true,
           .answer = {shift("sliding_friction", 0.1, 0.2), shift("rolling_friction", -1.5, 0.3)}},
          {.name = "filling",
           .from = "dense",
           .to = "pour",
           .replicates = 16,
           .answer = {shift("sliding_friction", 1.1, 0.8), shift("rolling_friction", 0.5, 0.4)}}}};
}

Evidence WithTable(const std::string& name, std::int64_t last_trial) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2, .coarse_design = true});
  evidence.folder = std::filesystem::path(testing::TempDir()) / ("talus_sensitivity_" + name);
  std::filesystem::remove_all(evidence.folder);
  std::filesystem::create_directories(evidence.folder);
  WriteSensitivity(Table(last_trial), evidence.folder);
  return evidence;
}

TEST(SensitivityView, ShiftsBeyondHalfOfARangeAreMarked) {
  const json page = json::parse(PageJson(MakeReportData(WithTable("whole", 60))))["sensitivity"];
  EXPECT_FALSE(page["outdated"]);
  ASSERT_EQ(page["moves"].size(), 2u);
  const json& restitution = page["moves"][0]["answer"];
  EXPECT_FALSE(restitution[0]["exceeds"]);
  EXPECT_TRUE(restitution[0]["told"]);
  EXPECT_TRUE(restitution[1]["exceeds"]);
  EXPECT_TRUE(page["moves"][0]["moves_still"]);
  EXPECT_FALSE(page["moves"][1]["moves_still"]);
  EXPECT_FALSE(page["moves"][0]["fits_no_set"]);
  const json& filling = page["moves"][1]["answer"];
  EXPECT_FALSE(filling[0]["exceeds"]);
  EXPECT_FALSE(filling[0]["told"]);
  ASSERT_EQ(page["alarms"].size(), 1u);
  EXPECT_THAT(page["alarms"][0].get<std::string>(),
              HasSubstr("restitution 0.6 in place of 0.9 would move rolling_friction from 0.15 to "
                        "0.11 ± 0.01"));
}

TEST(SensitivityView, WithoutAFileThereIsNone) {
  const Evidence evidence =
      test::MakeSyntheticCampaign({.num_parameters = 2, .coarse_design = true});
  EXPECT_FALSE(ReadSensitivity(evidence).has_value());
  EXPECT_TRUE(json::parse(PageJson(MakeReportData(evidence)))["sensitivity"].is_null());
}

TEST(SensitivityView, MadeBeforeTheLastTrialsIsCalledOutdated) {
  EXPECT_TRUE(ReadSensitivity(WithTable("old", 59))->is_outdated);
}

// A parameter was searched later: the table says nothing of it, and its columns are others.
TEST(SensitivityView, MadeBeforeAParameterWasSearchedIsLeftOut) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 3, .coarse_design = true});
  evidence.folder = WithTable("fewer", 60).folder;
  EXPECT_FALSE(ReadSensitivity(evidence).has_value());
}

TEST(SensitivityView, ADamagedOneIsLeftOutAndNamedWithTheRemedy) {
  const Evidence evidence = WithTable("damaged", 60);
  base::WriteFileAtomically(SensitivityFile(evidence.folder), R"({"moves": 3})");
  const ReportData data = MakeReportData(evidence);
  EXPECT_FALSE(data.sensitivity);
  ASSERT_EQ(data.left_out.size(), 1u);
  EXPECT_THAT(data.left_out[0], HasSubstr("sensitivity.json"));
  EXPECT_THAT(data.left_out[0], HasSubstr("run `talus sensitivity` again"));
}

}  // namespace sensitivity_view_test
}  // namespace talus::analysis
