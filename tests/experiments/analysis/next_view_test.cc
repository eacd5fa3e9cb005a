// What the report shows of `talus next`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/views/next_table_view.h"
#include "experiments/analysis/report/write_report.h"
#include "imaging/formats/images/image_file.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kNextJson = R"({"after_trial": 60,
  "width_90": {"sliding_friction": 0.5, "rolling_friction": 0.4},
  "candidates": [
    {"kind": "test", "name": "wide plate", "what": "carry it out in 3 runs", "num_simulations": 38,
     "core_time_s": 150.0, "bits": 1.91,
     "width_90": {"sliding_friction": 0.25, "rolling_friction": 0.1},
     "told_apart": [[0.1, 0.6], [0.6, 0.1]], "picture": "/elsewhere/next/wide-plate.png"},
    {"kind": "test", "name": "rough plate", "what": "carry it out in 3 runs", "num_simulations": 38,
     "core_time_s": 150.0, "bits": null, "width_90": null}]})";

// The folder of a synthetic campaign with what `talus next` leaves there.
Evidence WithNext(const std::string& name, const std::string& text) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2, .coarse_design = true});
  evidence.folder = std::filesystem::path(testing::TempDir()) / ("talus_next_" + name);
  std::filesystem::remove_all(evidence.folder);
  std::filesystem::create_directories(evidence.folder / "next");
  base::WriteFileAtomically(evidence.folder / "next" / "next.json", text);
  imaging::WritePng(
      evidence.folder / "next" / "wide-plate.png",
      imaging::GrayImage{.width = 4, .height = 2, .pixels = {0, 0, 0, 0, 9, 9, 9, 9}});
  return evidence;
}

TEST(NextTable, OfTheCampaignIsShownWithItsPicturesAndAmongTheSteps) {
  const ReportData data = MakeReportData(WithNext("whole", kNextJson));
  ASSERT_TRUE(data.next_table.has_value());
  EXPECT_FALSE(data.next_table->is_outdated);
  // Half of one range and a quarter of the other; searched from 0.001 to 0.7.
  const auto step = std::find_if(data.next_steps.begin(), data.next_steps.end(),
                                 [](const NextStep& s) { return s.remaining == 0.5 * 0.25; });
  ASSERT_NE(step, data.next_steps.end());
  EXPECT_EQ(step->what, "Wide plate: carry it out in 3 runs");
  EXPECT_THAT(step->leaves, HasSubstr("μₜ known within 0.17 (now 0.35)"));
  for (const NextStep& s : data.next_steps) EXPECT_THAT(s.what, Not(HasSubstr("rough plate")));
  const json next = json::parse(PageJson(data))["next"];
  EXPECT_EQ(next["candidates"][0]["bits"], 1.91);
  EXPECT_EQ(next["candidates"][0]["picture_width"], 4);
  EXPECT_THAT(next["candidates"][0]["uri"].get<std::string>(), StartsWith("data:image/png"));
  EXPECT_TRUE(next["candidates"][1]["bits"].is_null());
  EXPECT_TRUE(next["candidates"][1]["uri"].is_null());
}

TEST(NextTable, MadeBeforeTheLastTrialsIsCalledOutdated) {
  std::string old = kNextJson;
  old.replace(old.find("60"), 2, "59");
  EXPECT_TRUE(ReadNextTable(WithNext("old", old))->is_outdated);
}

TEST(NextTable, ADamagedOneIsNamedWithTheRemedy) {
  try {
    ReadNextTable(WithNext("damaged", R"({"candidates": 3})"));
    FAIL();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("next.json"));
    EXPECT_THAT(error.what(), HasSubstr("run it again"));
  }
}

}  // namespace
}  // namespace talus::analysis
