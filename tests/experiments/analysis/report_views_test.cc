// What the report's charts of the space, the region and the heaps show.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/analysis/compare/crop.h"
#include "experiments/analysis/report/data/tables.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/views/model_views.h"
#include "experiments/analysis/report/write_report.h"
#include "imaging/heap/metrics.h"
#include "optimizer/designs/r_sequence.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace report_views_test {

using nlohmann::json;

// Where every set fits the shadow is the whole plane, also between draws on nine stripes.
TEST(PosteriorPairs, StripesOfTheDrawsAreNotTakenForTheRegion) {
  Evidence evidence;
  for (const char* name : {"a", "b", "c"}) {
    evidence.parameters.push_back(
        {.range = {.name = name, .low = 0, .high = 1}, .symbol = name, .unit = "", .column = name});
  }
  ModelEvidence& model = evidence.model.emplace();
  model.draws.resize(900, 3);
  for (int i = 0; i < 900; ++i) model.draws.row(i) << i / 900.0, (i % 9 + 0.5) / 9, 0.5;
  model.credible_levels = [](const Eigen::MatrixXd& points) {
    return Eigen::VectorXd::Constant(points.rows(), 0.5).eval();
  };
  const PairMap pair = PosteriorPairs(evidence).front();
  const auto inside = std::ranges::count_if(pair.value, [](double level) { return level < 0.9; });
  EXPECT_GT(inside, 0.99 * static_cast<double>(pair.value.size()));
}

TEST(RegionHistory, HasOnePointForEachNumberOfTrials) {
  ReportData data = MakeReportData(test::MakeSyntheticCampaign({.num_parameters = 2}));
  // Half of a bent valley's plane at most, and some of it.
  EXPECT_GT(RegionShare(data), 0.05);
  EXPECT_LT(RegionShare(data), 0.5);
  std::vector<RegionPoint> history;
  Follow(data, history);
  Follow(data, history);
  ASSERT_EQ(history.size(), 1u);
  EXPECT_EQ(history[0].num_trials, 60);
  data.evidence.trials.pop_back();
  Follow(data, history);
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[1].num_trials, 59);
  data.region_history = history;
  EXPECT_EQ(json::parse(PageJson(data))["region_history"][1][0], 59);
  Follow(MakeReportData(test::MakeSyntheticCampaign({.num_trials = 12})), history);  // no model
  EXPECT_EQ(history.size(), 2u);
}

TEST(RegionHistory, CountsTheTrialsOfAllExperiments) {
  ReportData data = MakeReportData(test::MakeSyntheticCampaign({.num_parameters = 2}));
  data.evidence.of_others.assign(3, TrialEvidence{});
  data.evidence.of_others[0].state = journal::TrialStatus::kRunning;
  std::vector<RegionPoint> history;
  Follow(data, history);
  EXPECT_EQ(history.at(0).num_trials, 62);
}

// Draws as a posterior that knows nothing makes them: a third of an even sequence of 6000 points.
TEST(Marginals, AFlatDensityOfOneOfSixParametersHasNoStripes) {
  const Eigen::MatrixXd even = optimizer::RSequence(6000, 6, 1);
  Evidence evidence;
  evidence.parameters.assign(
      6, {.range = {.name = "a", .low = 0, .high = 1}, .symbol = "a", .unit = "", .column = "a"});
  evidence.model.emplace().draws = even(Eigen::seqN(0, 2000, 3), Eigen::all);
  const std::vector<Marginal> marginals = Marginals(evidence);
  ASSERT_EQ(marginals.size(), evidence.parameters.size());
  for (const Marginal& marginal : marginals) {
    EXPECT_FALSE(marginal.density.empty());
    for (const double density : marginal.density) EXPECT_NEAR(density, 1, 0.08);
  }
}

TEST(RepresentativeViews, RecommendedStandsInTheMiddleWithWhatTheModelExpects) {
  Evidence evidence = test::MakeSyntheticCampaign();
  evidence.answer->representative = {{0.1, 0.5, 1e-5}, test::SyntheticTruth(), {0.6, 0.1, 3e-5}};
  LeftOut none;
  const auto views = RepresentativeViews(evidence, none);
  ASSERT_EQ(views.size(), 3u);
  EXPECT_TRUE(views[1].is_recommended);
  EXPECT_DOUBLE_EQ(views[1].values[0], evidence.answer->parameters[0].value);
  ASSERT_NE(views[1].trial, nullptr);
  EXPECT_EQ(views[1].trial->kind, journal::TrialKind::kConfirm);  // simulated at that very set
  // No heap stands for a set unless its own set fits.
  for (const RepresentativeView& view : views) {
    if (view.trial == nullptr) continue;
    EXPECT_LE(evidence.model->credible_levels(view.trial->point.transpose())[0], 0.9);
  }
  EXPECT_GT(views[0].expected, views[1].expected);
}

TEST(HeapBox, HoldsThePowderAndThePlateAndLittleMore) {
  const Evidence evidence = test::MakeSyntheticCampaign({.num_trials = 2});
  const imaging::Profile& aehp = evidence.reference.aehp;
  const Box box = HeapBox({&aehp});
  const imaging::GrayImage cut = Cropped(aehp.image, box);
  EXPECT_EQ(imaging::Nebp(cut), imaging::Nebp(aehp.image));  // nothing of the heap is lost
  EXPECT_LT(cut.pixels.size(), 0.75 * static_cast<double>(aehp.image.pixels.size()));
  const double plate = aehp.frame.plate_diameter / aehp.frame.pixel_size;
  EXPECT_GE(box.width, plate);
}

}  // namespace report_views_test
}  // namespace talus::analysis
