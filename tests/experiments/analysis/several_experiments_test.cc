// Comparison, report and export of campaigns with several experiments, with images or without.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/files/file.h"
#include "experiments/analysis/compare/compare_tables.h"
#include "experiments/analysis/compare/experiment_fit.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/knowledge.h"
#include "experiments/analysis/export/export.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/write_report.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/journal/objective.h"
#include "tests/experiments/finished_campaigns.h"
#include "tests/experiments/two_experiments.h"

namespace talus::campaign {
namespace several_experiments_test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

analysis::ReportData DataOf(const fs::path& folder, const std::string& experiment = {}) {
  analysis::Evidence evidence = analysis::GatherEvidence(folder, experiment);
  std::vector<analysis::Evidence> others = analysis::GatherOthers(folder, evidence);
  analysis::AddModel(folder, evidence, others);
  return analysis::MakeReportData(std::move(evidence), std::move(others));
}

std::string CompareText(const fs::path& folder, const std::string& experiment = {}) {
  const analysis::Evidence evidence = analysis::GatherEvidence(folder, experiment);
  const auto findings = analysis::CompareObjectives(evidence);
  return analysis::ComparisonText({evidence, findings});
}

// Two bulk tests that give a number each and no image.
class NumbersAlone : public TwoExperiments {
 protected:
  fs::path FinishedNumbers() const {
    static FinishedCampaigns<std::string> campaigns;
    campaigns.Copy("numbers", scratch_.path() / "run", RunNumbers);
    return scratch_.path() / "run";
  }

 private:
  static void RunNumbers(const fs::path& scratch) {
    const fs::path in = scratch / "in";
    fs::create_directories(in);
    std::ofstream(in / "spec.json") << R"({"name": "numbers", "experiments": [
        {"name": "balance", "mass_fallen": {"value": "23 mg", "sd": "1 mg"}},
        {"name": "tapped", "rig": {"kind": "tapped_density", "diameter": "12 mm"},
         "filling": {"kind": "pour"}, "tapped_density": {"value": "1480 kg/m^3", "sd": "3 kg/m^3"}}],
      "powder": {"material": {"density": 2500},
                 "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
      "coarse_graining": {"scale_factor": 2},
      "parameters": {"sliding_friction": {"min": 0.1, "max": 0.8},
                     "rolling_friction": {"min": 0.05, "max": 0.5}},
      "budget": {"simulations": 24}, "confirm": {"candidates": 1, "replicates": 2}, "workers": 1})";
    BeginCampaign(in / "spec.json", scratch / "run", {});
    EXPECT_EQ(RunFake(scratch / "run", {}), CampaignEnd::kFinished);
  }
};

TEST_F(NumbersAlone, ArePredictedAndMeasuredSideBySideOnAPageWithoutPictures) {
  const fs::path folder = FinishedNumbers();
  const analysis::ReportData data = DataOf(folder);
  EXPECT_TRUE(data.outlines.empty());
  EXPECT_TRUE(data.pictures.empty());
  const json page = json::parse(analysis::PageJson(data));
  EXPECT_FALSE(page["campaign"]["has_image"].get<bool>());
  EXPECT_EQ(page["campaign"]["experiment"], "balance");
  EXPECT_FALSE(page["pairs"].empty());  // the region
  EXPECT_THAT(page["headline"]["sentences"].dump(), HasSubstr("fit every measurement"));
  const json& fit = page["headline"]["fit"];
  ASSERT_EQ(fit.size(), 2u);
  EXPECT_EQ(fit[0]["what"], "mass fallen");
  EXPECT_EQ(fit[0]["measured"], "23 ± 1 mg");
  EXPECT_THAT(fit[0]["simulated"].get<std::string>(),
              ::testing::MatchesRegex("2[0-9.]+ mg as the mean of 2 simulations; "
                                      "predicted 2[0-9.]+ ± [0-9.]+ mg"));
  EXPECT_EQ(fit[1]["measured"], "1480 ± 3 kg/m³");
  EXPECT_LT(fit[1]["implausibility"].get<double>(), 3);
  // The trials' objective is how far they are from the number that was measured.
  EXPECT_EQ(page["campaign"]["objective"]["metric"], "mass_fallen_mg");
  EXPECT_EQ(page["campaign"]["objective"]["reference"], 23);
  EXPECT_THAT(page["methods"].get<std::string>(), HasSubstr("the tapped density of \"tapped\""));
  const fs::path report = analysis::WriteReport(data, folder / "report");
  EXPECT_THAT(base::ReadFile(folder / "report/tables/objectives.csv"),
              HasSubstr("\nmass_fallen_kg,trials,mass_fallen_kg,"));
  EXPECT_GT(fs::file_size(report), 100'000u);
}

TEST_F(NumbersAlone, AreComparedByTheirDistanceFromWhatWasMeasured) {
  const fs::path folder = FinishedNumbers();
  EXPECT_THAT(CompareText(folder), HasSubstr("Mass fallen"));
  EXPECT_THAT(CompareText(folder), HasSubstr("23 ± 1 mg"));
  EXPECT_THAT(CompareText(folder), Not(HasSubstr("SAD")));
  EXPECT_THAT(CompareText(folder, "tapped"), HasSubstr("1480 ± 3 kg/m³"));
  const analysis::Evidence tapped = analysis::GatherEvidence(folder, "tapped");
  const auto findings = analysis::CompareObjectives(tapped);
  ASSERT_EQ(findings.size(), 1u);
  const analysis::ComparedSet& best = findings[0].from_trials.best.front();
  EXPECT_NEAR(best.objective, std::abs(best.quantity - 1480), 1e-9);
  // The number follows rolling friction alone, by 350 kg/m³ of it; seeds scatter by 4.
  EXPECT_NEAR(best.values[1], kTrueRolling, 0.05);
}

// The drawn heap's top follows sliding friction and its slope rolling friction: an angle sees one
// of the two, the whole heap both.
TEST_F(TwoExperiments, AnAngleOfReposeKnowsLessThanTheWholeHeap) {
  const fs::path folder = Finished("run");
  const analysis::ReportData data = DataOf(folder, "heap");
  const auto& knowledge = data.evidence.knowledge;
  ASSERT_GE(knowledge.size(), 2u);
  const analysis::ObjectiveKnowledge& heap = knowledge.front();
  EXPECT_EQ(heap.title, "whole heap (SAD, RMSE)");
  EXPECT_TRUE(heap.Holds());
  EXPECT_EQ(heap.num_refits, 4);
  double largest = 0;
  for (const analysis::ObjectiveKnowledge& angle : knowledge) {
    if (angle.absent.empty()) largest = std::max(largest, angle.region);
  }
  EXPECT_GT(largest, 3 * heap.region);
  const std::vector<analysis::ObjectiveFinding> findings =
      analysis::CompareObjectives(data.evidence);
  EXPECT_THAT(analysis::ComparisonText({data.evidence, findings}),
              HasSubstr("holds the recommended set"));
}

// The jackknife of four groups: ln of the region without each, their sd √(3/4 Σ (x - mean)²), and
// 1.645 of it to either side.
TEST_F(TwoExperiments, ARegionIsKnownAsItChangesWithoutEachQuarterOfTheTrials) {
  JointView view = ReadJointView(Finished("run"));
  view.record.experiments[0].reference.clear();  // the whole heap alone
  const auto heap_of = [&](const JointView& some) {
    return analysis::KnowledgeOf(some, 0, PointOf(view.trials.front())).front();
  };
  std::vector<double> logs;
  for (int group = 0; group < 4; ++group) {
    JointView fewer = view;
    int place = 0;
    std::erase_if(fewer.observations, [&](const optimizer::Observation& observation) {
      return observation.experiment == 0 && place++ % 4 == group;
    });
    logs.push_back(std::log(heap_of(fewer).region));
  }
  const double mean = (logs[0] + logs[1] + logs[2] + logs[3]) / 4;
  double squares = 0;
  for (const double log : logs) squares += (log - mean) * (log - mean);
  ASSERT_GT(squares, 1e-6);
  const double factor = std::exp(1.64485 * std::sqrt(0.75 * squares));
  const analysis::ObjectiveKnowledge heap = heap_of(view);
  EXPECT_NEAR(heap.region_low * factor / heap.region, 1, 1e-5);
  EXPECT_NEAR(heap.region_high, std::min(1.0, heap.region * factor), 1e-5 * heap.region_high);
}

// Where every set stands as a column, no trial has an angle: nothing is known by it, and that is
// said.
TEST_F(TwoExperiments, AnAngleThatNoTrialDefinesKnowsNothing) {
  const fs::path folder = Finished("run");
  JointView view = ReadJointView(folder);
  const std::string angle(journal::InfoOf(journal::Objective::kAor1).metric);
  for (journal::TrialRecord& trial : view.trials) {
    std::erase_if(trial.metrics, [&](const auto& metric) { return metric.name == angle; });
  }
  const auto knowledge = analysis::KnowledgeOf(view, 0, PointOf(view.trials.front()));
  EXPECT_THAT(knowledge, ::testing::Contains(::testing::Field(&analysis::ObjectiveKnowledge::absent,
                                                              HasSubstr("too few trials"))));
}

TEST_F(TwoExperiments, AreEachComparedAndBothStandOnThePageWithEitherShown) {
  const fs::path folder = Finished("run");
  EXPECT_THAT(CompareText(folder), HasSubstr("best by SAD"));
  EXPECT_THAT(CompareText(folder), Not(HasSubstr("Mass fallen")));  // not measured by this one
  EXPECT_THAT(CompareText(folder, "fast lift"), HasSubstr("23 ± 1 mg"));
  for (const char* shown : {"heap", "fast lift"}) {
    const analysis::ReportData data = DataOf(folder, shown);
    const json page = json::parse(analysis::PageJson(data));
    EXPECT_EQ(page["campaign"]["experiment"], shown);
    EXPECT_EQ(page["campaign"]["num_experiments"], 2);
    EXPECT_EQ(page["campaign"]["counts"]["searched"], 20);
    EXPECT_EQ(page["campaign"]["counts"]["confirming"], 4);
    const json& fit = page["headline"]["fit"];
    ASSERT_EQ(fit.size(), 3u);  // a shape each, and the mass
    EXPECT_EQ(fit[0]["experiment"], "heap");
    EXPECT_EQ(fit[1]["experiment"], "fast lift");
    EXPECT_EQ(fit[2]["measured"], "23 ± 1 mg");
    EXPECT_FALSE(data.outlines.empty());
    EXPECT_FALSE(page["slices"].empty());
    // The other one stands beside it, with its own trials, profiles and measures.
    ASSERT_EQ(page["others"].size(), 1u);
    const json& other = page["others"][0];
    EXPECT_NE(other["campaign"]["experiment"], shown);
    EXPECT_EQ(other["trials"]["id"].size() + page["trials"]["id"].size(), 24u);
    EXPECT_FALSE(other["outlines"].empty());
    EXPECT_FALSE(other["measures"].empty());
    EXPECT_FALSE(other["objectives"].empty());
  }
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  const std::string csv = analysis::TrialsCsv(journal.Campaign(), journal.Trials());
  EXPECT_THAT(csv, HasSubstr(",heap,2,"));
  EXPECT_THAT(csv, HasSubstr(",fast lift,2,"));
  // A deck that echoes what it was given took the parameter's place.
  std::vector<journal::TrialRecord> trials = journal.Trials();
  trials[0].metrics.push_back({"sliding_friction", 99, "-", "", 0});
  trials[0].metrics.push_back({"status", 1, "-", "", 0});
  EXPECT_THAT(
      analysis::TrialsCsv(journal.Campaign(), trials),
      ::testing::AllOf(HasSubstr(",scale_factor,sliding_friction,"),
                       HasSubstr(",sliding_friction_of_engine,"), HasSubstr(",status_of_engine,")));
}

// The page draws what the verdict states; both are of the model that is asked again.
TEST_F(TwoExperiments, TheDrawnRegionIsAsLargeAsTheVerdictSays) {
  const fs::path folder = Finished("run");
  const analysis::ReportData data = DataOf(folder);
  const double stated = data.evidence.answer->posterior->region_volume;
  // Kernels round the draws made 1.5 to 3 times the region. Importance sampling knows the volume to
  // some hundredths, cells of 1/120 a region of 0.01 to a tenth.
  EXPECT_NEAR(analysis::RegionShare(data) / stated, 1, 0.15) << stated;
}

// What a reader is told of how well the recommended set fits.
class Fit : public testing::Test {
 protected:
  Fit() {
    record_.experiments.resize(2);
    record_.experiments[0].name = "heap";
    record_.experiments[0].aehp_png = "png";
    record_.experiments[0].num_heaps = 5;
    record_.experiments[0].noise_mm2 = 0.7;
    record_.experiments[1].name = "tapped";
    record_.experiments[1].scalars = {{"tapped_density_kg_per_m3", 1480, 4}};
    result_.objective_unit = "mm²";
    result_.experiments = {
        {.name = "heap", .has_image = true, .num_heaps = 5, .noise_floor = 0.7},
        {.name = "tapped",
         .numbers = {{.name = "tapped_density_kg_per_m3", .value = 1480, .standard_error = 4}}}};
    ResultConfirmed heap{.name = "heap", .num_trials = 2, .sad_mm2 = 0.6};
    heap.profile_sad_mm2 = 0.5;
    heap.over_floor = 0.714;
    const ResultConfirmed tapped{.name = "tapped",
                                 .num_trials = 2,
                                 .scalars = {{.name = "tapped_density_kg_per_m3",
                                              .num_trials = 2,
                                              .mean = 1500,
                                              .standard_error = 0.1,
                                              .degrees = 1}}};
    result_.confirmed.resize(1);
    result_.confirmed[0].experiments = {heap, tapped};
  }
  journal::CampaignRecord record_;
  Answer result_;
};

TEST_F(Fit, IsSaidOfEachMeasurementAndInASentence) {
  const auto rows = analysis::FitRows(result_, record_);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].measured, "5 runs, each 0.7 mm² SAD from the mean of the others");
  EXPECT_EQ(rows[0].simulated, "0.5 mm² SAD as the mean of 2 simulations; 0.6 mm² in single runs");
  EXPECT_EQ(rows[0].judgement, "0.714 times as far as the runs are from each other");
  EXPECT_EQ(rows[0].meets, Meets::kYes);
  EXPECT_EQ(rows[1].simulated, "1500 kg/m³ as the mean of 2 simulations");
  EXPECT_EQ(rows[1].judgement, "5 standard errors of the measurement and the simulations away");
  EXPECT_EQ(rows[1].meets, Meets::kNo);
  EXPECT_EQ(analysis::FitSentence(rows),
            "With these values simulations give the shape of \"heap\" within the errors of "
            "measurement and simulations. With these values simulations miss the tapped density of "
            "\"tapped\".");
}

TEST_F(Fit, AnExperimentThatNoSetMeetsIsMissedHoweverNearItsImageMayBe) {
  result_.posterior.emplace().experiments.push_back({.name = "heap", .implausibility = 3.4});
  const auto rows = analysis::FitRows(result_, record_);
  EXPECT_EQ(rows[0].meets, Meets::kNo);
  EXPECT_EQ(rows[0].implausibility, 3.4);
}

TEST_F(Fit, WithoutAFreshSeedIsWhatTheModelExpects) {
  result_.confirmed.clear();
  auto& standings = result_.posterior.emplace().experiments;
  standings.push_back({.name = "heap", .predicted = 0.8});
  standings.push_back({.name = "tapped"});
  standings.back().numbers = {{.predicted = 1478, .predicted_sd = 2}};
  const auto rows = analysis::FitRows(result_, record_);
  EXPECT_EQ(rows[0].simulated, "0.8 mm² predicted, not confirmed");
  EXPECT_EQ(rows[0].meets, Meets::kUnknown);
  EXPECT_EQ(rows[1].simulated, "predicted 1478 ± 2 kg/m³");
  EXPECT_EQ(rows[1].meets, Meets::kYes);
  EXPECT_EQ(analysis::FitSentence(rows),
            "The model expects the tapped density of \"tapped\" within the errors of measurement "
            "and prediction. No simulation with these values tells how well they meet the shape of "
            "\"heap\".");
  // 10 off where the measurement is known to 4: 2.5 of it, but the model knows its own to 6.
  standings.back().numbers = {{.predicted = 1470, .predicted_sd = 6}};
  const auto unsure = analysis::FitRows(result_, record_);
  EXPECT_EQ(unsure[1].meets, Meets::kYes);
  EXPECT_EQ(unsure[1].judgement, "1.4 standard errors of the measurement and the prediction away");
}

}  // namespace several_experiments_test
}  // namespace talus::campaign
