// What the report shows of `talus next` and `talus predict`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/views/next_table_view.h"
#include "experiments/analysis/report/write_report.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "imaging/formats/images/image_file.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace next_view_test {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kNextJson = R"({"after_trial": 60, "asked": " tests.json",
  "width_90": {"sliding_friction": 0.5, "rolling_friction": 0.4},
  "candidates": [
    {"kind": "test", "name": "wide plate", "what": "carry it out in 3 runs", "num_simulations": 38,
     "core_time_s": 150.0, "remaining": 0.125, "bits": 1.91,
     "width_90": {"sliding_friction": 0.25, "rolling_friction": 0.1},
     "told_apart": [[0.1, 0.6], [0.6, 0.1]], "picture": "/elsewhere/next/wide-plate.png"},
    {"kind": "test", "name": "rough plate", "what": "carry it out in 3 runs", "num_simulations": 38,
     "core_time_s": 150.0, "remaining": null, "bits": null, "width_90": null}]})";

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
  // Half of a range that is searched from 0.001 to 0.7.
  const auto step = std::find_if(data.next_steps.begin(), data.next_steps.end(),
                                 [](const NextStep& s) { return s.remaining == 0.125; });
  ASSERT_NE(step, data.next_steps.end());
  EXPECT_EQ(step->what, "Wide plate: carry it out in 3 runs");
  EXPECT_THAT(step->leaves, HasSubstr("μₜ known within 0.17 (now 0.35)"));
  for (const NextStep& s : data.next_steps) EXPECT_THAT(s.what, Not(HasSubstr("rough plate")));
  const json next = json::parse(PageJson(data))["next"];
  EXPECT_EQ(next["candidates"][0]["bits"], 1.91);
  EXPECT_EQ(next["candidates"][0]["remaining"], 0.125);
  EXPECT_EQ(next["candidates"][0]["picture_width"], 4);
  EXPECT_THAT(next["candidates"][0]["uri"].get<std::string>(), StartsWith("data:image/png"));
  EXPECT_TRUE(next["candidates"][1]["bits"].is_null());
  EXPECT_TRUE(next["candidates"][1]["uri"].is_null());
}

TEST(NextTable, ForAGoalHasItsColumnInTheUnitThatPeopleRead) {
  json with_goal = json::parse(kNextJson);
  with_goal["goal"] = {
      {"process", "spread"}, {"observable", "thickness_m"}, {"half_width_90", 2e-5}};
  with_goal["candidates"][0]["goal_half_width_90"] = 1e-5;
  with_goal["candidates"][1]["goal_half_width_90"] = nullptr;
  const ReportData data = MakeReportData(WithNext("goal", with_goal.dump()));
  const json next = json::parse(PageJson(data))["next"];
  EXPECT_EQ(next["goal"]["process"], "spread");
  EXPECT_EQ(next["goal"]["unit"], "mm");
  EXPECT_NEAR(next["goal"]["half_width"].get<double>(), 0.02, 1e-12);
  EXPECT_NEAR(next["candidates"][0]["goal"].get<double>(), 0.01, 1e-12);
  EXPECT_TRUE(next["candidates"][1]["goal"].is_null());
}

TEST(NextTable, MadeBeforeTheLastTrialsIsCalledOutdated) {
  std::string old = kNextJson;
  old.replace(old.find("60"), 2, "59");
  LeftOut none;
  EXPECT_TRUE(ReadNextTable(WithNext("old", old), none)->is_outdated);
}

// All that was not known had a "?", and the advice to simulate it.
TEST(NextTable, WhatNoSimulationWillTellIsNotAskedToBeSimulated) {
  json table = json::parse(kNextJson);
  json silent = table["candidates"][1], impossible = silent;
  silent["needs_simulations"] = false;  // they are made
  impossible["what"] = "cannot be simulated: no plate";
  impossible["num_simulations"] = 0;
  table["candidates"].insert(table["candidates"].end(), {silent, impossible});
  const json next = json::parse(PageJson(MakeReportData(WithNext("silent", table.dump()))))["next"];
  const auto needs = [&](std::size_t i) { return next["candidates"][i]["needs_simulations"]; };
  EXPECT_EQ(needs(0), false);
  EXPECT_EQ(needs(1), true);
  EXPECT_EQ(needs(2), false);
  EXPECT_EQ(needs(3), false);
}

TEST(NextTable, ADamagedOneIsLeftOutAndNamedWithTheRemedy) {
  const ReportData data = MakeReportData(WithNext("damaged", R"({"candidates": 3})"));
  EXPECT_FALSE(data.next_table);
  EXPECT_THAT(data.left_out, ElementsAre(AllOf(HasSubstr("next.json"), HasSubstr("run it again"))));
}

// The whole table went with it.
TEST(NextTable, ADamagedPictureIsLeftOutAlone) {
  const Evidence evidence = WithNext("picture", kNextJson);
  base::WriteFileAtomically(evidence.folder / "next/wide-plate.png", "no picture");
  const ReportData data = MakeReportData(evidence);
  ASSERT_TRUE(data.next_table);
  EXPECT_EQ(data.next_table->candidates.size(), 2u);
  EXPECT_THAT(data.left_out, ElementsAre(HasSubstr("wide-plate.png")));
}

// The folder of a synthetic campaign with what `talus predict` leaves there.
Evidence WithPrediction(const std::string& name, const std::string& text) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2, .coarse_design = true});
  evidence.folder = std::filesystem::path(testing::TempDir()) / ("talus_predicted_" + name);
  std::filesystem::remove_all(evidence.folder);
  std::filesystem::create_directories(evidence.folder / "predict/mixer");
  base::WriteFileAtomically(evidence.folder / "predict/mixer/prediction.json", text);
  imaging::WritePng(
      evidence.folder / "predict/mixer/mean_profile.png",
      imaging::GrayImage{.width = 4, .height = 2, .pixels = {0, 0, 0, 0, 9, 9, 9, 9}});
  return evidence;
}

TEST(Predictions, StandOnThePageWithTheirPicturesInTheUnitsThatPeopleRead) {
  const Prediction prediction{
      .name = "mixer",
      .test = "drum",
      .last_trial = 1,
      .num_runs = 36,
      .num_ended = 36,
      .draws = {{.weight = 0.4, .values = {0.2, 0.1}}, {.weight = 0.6, .values = {0.5, 0.1}}},
      .numbers = {{.name = "mass_left_kg",
                   .is_usual = true,
                   .num_defined = 36,
                   .mean = 2e-6,
                   .low = 1e-6,
                   .high = 3e-6,
                   .parameters_share = 0.25}},
      .mean_profile = "mean_profile.png",
      .most_different = "lost.png",
      .different = {1, 0}};
  const ReportData data =
      MakeReportData(WithPrediction("whole", base::JsonText(base::ToJson(prediction), 2)));
  ASSERT_EQ(data.predictions.size(), 1u);
  EXPECT_TRUE(data.predictions[0].is_outdated);
  const json shown = json::parse(PageJson(data))["predictions"][0];
  EXPECT_EQ(shown["name"], "mixer");
  EXPECT_EQ(shown["numbers"][0]["mean"], 2);  // mg
  EXPECT_EQ(shown["numbers"][0]["unit"], "mg");
  EXPECT_EQ(shown["numbers"][0]["parameters_share"], 0.25);
  EXPECT_TRUE(shown["numbers"][0]["run_sd"].is_null());
  EXPECT_THAT(shown["mean"].get<std::string>(), StartsWith("data:image/png;base64,"));
  EXPECT_TRUE(shown["different"].is_null());  // a picture that is gone is left out
  EXPECT_EQ(shown["different_sets"][0][0], 0.5);
  WriteReport(data, data.evidence.folder / "report");
  EXPECT_TRUE(std::filesystem::exists(data.evidence.folder /
                                      "report/figures/predict_mixer_mean_profile.png"));
}

TEST(Predictions, ADamagedFileIsLeftOutAndNamedOnThePage) {
  const ReportData data = MakeReportData(WithPrediction("damaged", "{\"name\": 3}"));
  EXPECT_TRUE(data.predictions.empty());
  const json page = json::parse(PageJson(data));
  ASSERT_EQ(page["left_out"].size(), 1u);
  EXPECT_THAT(page["left_out"][0].get<std::string>(), HasSubstr("mixer/prediction.json"));
}

TEST(Predictions, ADamagedPictureIsLeftOutAlone) {
  const Prediction prediction{.name = "mixer", .test = "drum", .mean_profile = "mean_profile.png"};
  const Evidence evidence = WithPrediction("picture", base::JsonText(base::ToJson(prediction), 2));
  base::WriteFileAtomically(evidence.folder / "predict/mixer/mean_profile.png", "");
  const ReportData data = MakeReportData(evidence);
  ASSERT_EQ(data.predictions.size(), 1u);
  EXPECT_TRUE(data.predictions[0].mean.png.empty());
  EXPECT_THAT(data.left_out, ElementsAre(HasSubstr("mean_profile.png")));
}

// Heaps and maps only add to a report; one damaged file of them was the end of all of it.
TEST(LeftOut, ADamagedHeapOrMapIsNamedAndTheReportMadeWithoutIt) {
  Evidence evidence = WithPrediction("heap", "{}");
  std::filesystem::remove_all(evidence.folder / "predict");
  const int trial = ConfirmingTrial(evidence)->id;
  const std::filesystem::path folder = campaign::CampaignFolder{evidence.folder}.trial(trial);
  std::filesystem::create_directories(folder);
  base::WriteFileAtomically(folder / "heap.vtp", "<VTKFile type=");
  base::WriteFileAtomically(evidence.folder / "map.png", "no picture");
  evidence.answer->remains = {
      {.experiment = evidence.experiments[evidence.experiment], .file = "map.png"}};
  const ReportData data = MakeReportData(evidence);
  EXPECT_THAT(data.left_out,
              testing::UnorderedElementsAre(HasSubstr("heap.vtp"), HasSubstr("map.png")));
  ASSERT_FALSE(data.representative.empty());
  EXPECT_TRUE(data.representative[0].heap.png.empty());
}

}  // namespace next_view_test
}  // namespace talus::analysis
