#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/report/base64.h"
#include "experiments/analysis/report/figures.h"
#include "experiments/analysis/report/page.h"
#include "experiments/analysis/report/svg_chart.h"
#include "experiments/analysis/report/tables.h"
#include "experiments/analysis/report/write_report.h"
#include "experiments/campaign/campaign_result.h"
#include "tests/experiments/synthetic_campaign.h"
#include "tests/experiments/synthetic_journal.h"

namespace talus::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Report : public testing::Test {
 protected:
  static const ReportData& Data() {
    static const ReportData data = MakeReportData(test::MakeSyntheticCampaign());
    return data;
  }
  static std::string Table(const std::string& name) {
    for (const NamedText& table : ReportTables(Data())) {
      if (table.name == name) return table.text;
    }
    return {};
  }
};

TEST(Base64, GivesTheVectorsOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe\xfd"), "//79");
}

TEST_F(Report, PageLoadsNothingFromElsewhere) {
  const std::string page = ReportPage(Data());
  // Markup and style; that the scripts load nothing either is seen in a browser
  // (tests/system/report_browser_test).
  const std::string markup = page.substr(0, page.find("id=\"data\""));
  EXPECT_THAT(markup, Not(HasSubstr("//")));
  EXPECT_THAT(markup, Not(HasSubstr("@import")));
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  for (const char* placeholder : {"{{title}}", "{{css}}", "{{js}}", "{{echarts}}", "{{data}}"}) {
    EXPECT_EQ(page.find(placeholder), std::string::npos) << placeholder;
  }
}

TEST_F(Report, TextOfTheSpecCannotEndTheScript) {
  const std::string page = ReportPage(Data());
  ASSERT_THAT(Data().evidence.spec, HasSubstr("</script>"));
  const std::string start = "id=\"data\">";
  const auto from = page.find(start) + start.size();
  const json data = json::parse(page.substr(from, page.find("</script>", from) - from));
  EXPECT_EQ(data["spec"], Data().evidence.spec);
  EXPECT_EQ(data["trials"]["id"].size(), Data().evidence.trials.size());
}

TEST_F(Report, FailedTrialsHaveNoNumbersButTheirReason) {
  const json data = json::parse(PageJson(Data()));
  ASSERT_EQ(data["trials"]["state"][12], "failed");
  EXPECT_TRUE(data["trials"]["metrics"][0][12].is_null());
  EXPECT_THAT(data["trials"]["reason"][12].get<std::string>(), HasSubstr("not finite"));
}

TEST_F(Report, TablesHaveARowForEachTrialAndUnitsInTheirHeads) {
  const std::string trials = Table("trials");
  EXPECT_THAT(trials, StartsWith("trial,state,purpose,seed,scale_factor,sliding_friction,"
                                 "rolling_friction,surface_energy_J_per_m2,sad_mm2,"));
  EXPECT_EQ(std::count(trials.begin(), trials.end(), '\n'),
            static_cast<std::ptrdiff_t>(Data().evidence.trials.size()) + 1);
  const std::string best = Table("ten_best");
  EXPECT_EQ(std::count(best.begin(), best.end(), '\n'), 1 + 5 * 10);
}

TEST_F(Report, ChartsAsSvgHaveTheirData) {
  const auto figures = ReportFigures(Data());
  ASSERT_EQ(figures.size(), 2u + 3 + 2 * 3);  // convergence, outlines; slices; two for each pair
  for (const NamedText& figure : figures) {
    EXPECT_THAT(figure.text, StartsWith("<svg ")) << figure.name;
    EXPECT_THAT(figure.text, Not(HasSubstr("nan"))) << figure.name;
    EXPECT_THAT(figure.text, Not(HasSubstr("inf"))) << figure.name;
  }
  const std::string& convergence = figures[0].text;
  std::size_t points = 0;
  for (auto at = convergence.find("<circle"); at != std::string::npos;
       at = convergence.find("<circle", at + 1)) {
    ++points;
  }
  EXPECT_EQ(points, 56u + 4);  // of 60 trials 4 failed; and one in the legend for each purpose
}

TEST(SvgChart, PutsValuesWhereTheyBelong) {
  SvgChart chart({.title = "x", .low = 1e-6, .high = 1e-2, .log = true},
                 {.title = "y", .low = 0, .high = 10});
  chart.Points({{1e-4, 5}, {1, 5}}, {.width = 4});  // the second is off the axis
  // The plot is 550 by 340 pixels.
  EXPECT_THAT(chart.Text(), HasSubstr("<circle cx=\"275.00\" cy=\"170.00\""));
  EXPECT_EQ(chart.Text().find("<circle"), chart.Text().rfind("<circle"));
}

TEST_F(Report, OutlinesEndOnThePlateWithinIt) {
  for (const OutlineCurve& outline : Data().outlines) {
    ASSERT_GT(outline.x.size(), 10u);
    EXPECT_EQ(outline.height.front(), 0);
    EXPECT_EQ(outline.height.back(), 0);
    // The heap is shifted by up to some pixels of 60 µm.
    EXPECT_NEAR(outline.x.front(), -0.005, 3e-4);
    EXPECT_NEAR(outline.x.back(), 0.005, 3e-4);
  }
}

TEST_F(Report, ChancesOfPairsAreChancesAndHighestNearTheBestSet) {
  ASSERT_EQ(Data().pairs.size(), 3u);
  const PairChance& pair = Data().pairs[0];
  for (const double chance : pair.chance) {
    EXPECT_GE(chance, 0);
    EXPECT_LE(chance, 1 + 1e-12);
  }
  const auto highest = std::max_element(pair.chance.begin(), pair.chance.end());
  const auto cell = static_cast<std::size_t>(highest - pair.chance.begin());
  const std::size_t num_x = pair.x_edges.size() - 1;
  // Averaging over the third parameter may shift the ridge by some cells of twenty.
  const double reach = 2 * (pair.x_edges[1] - pair.x_edges[0]);
  const std::vector<double>& best = Data().own().from_model->values;
  EXPECT_NEAR(pair.x_edges[cell % num_x], best[pair.i], 2 * reach);
  EXPECT_NEAR(pair.y_edges[cell / num_x], best[pair.j], 2 * reach);
}

TEST_F(Report, JournalGivesBackWhatTheCampaignHas) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "talus_report_test";
  std::filesystem::remove_all(folder);
  const Evidence made = test::MakeSyntheticCampaign({.num_trials = 20});
  test::WriteSyntheticJournal(made, folder);
  const Evidence read = GatherEvidence(folder);
  EXPECT_EQ(read.name, made.name);
  EXPECT_EQ(read.max_simulations, made.max_simulations);
  ASSERT_EQ(read.trials.size(), made.trials.size());
  EXPECT_EQ(read.trials[3].values, made.trials[3].values);
  EXPECT_EQ(read.trials[3].metrics, made.trials[3].metrics);
  EXPECT_EQ(read.trials[12].state, journal::TrialStatus::kFailed);
  EXPECT_EQ(read.trials[12].reason, made.trials[12].reason);
  EXPECT_EQ(read.reference.aehp.image, made.reference.aehp.image);
  EXPECT_EQ(read.reference.aehp.frame, made.reference.aehp.frame);
  EXPECT_EQ(read.profile(4)->image, made.profile(4)->image);
  ASSERT_TRUE(read.conclusion);
  EXPECT_EQ(read.conclusion->values[2].high, made.conclusion->values[2].high);
  EXPECT_EQ(read.conclusion->num_confirmed, made.conclusion->num_confirmed);

  const auto page = WriteReport(MakeReportData(read), folder / "report");
  EXPECT_THAT(base::ReadFile(page), HasSubstr("Ti6Al4V"));
  EXPECT_TRUE(std::filesystem::exists(folder / "report" / "tables" / "trials.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "report" / "figures" / "aehp.png"));
  std::filesystem::remove_all(folder);
}

campaign::CampaignResult ResultWithPosterior() {
  campaign::CampaignResult result;
  result.objective = "sad_mm2";
  result.parameters.resize(2);
  result.parameters[0].name = "sliding_friction";
  result.parameters[1].name = "rolling_friction";
  result.correlation = {{1, -0.95}, {-0.95, 1}};
  result.posterior.emplace();
  result.posterior->region_volume = 0.2;
  result.posterior->branches = {
      {.share = 0.9, .values = {0.3, 0.1}, .low = {0.2, 0.05}, .high = {0.4, 0.2}}};
  return result;
}

TEST(ConclusionOf, VerdictSaysWhatKindOfAnswerThereIs) {
  campaign::CampaignResult result = ResultWithPosterior();
  EXPECT_THAT(
      ConclusionOf(campaign::ResultText(result)).verdict,
      StartsWith("The measurements determine a curve, not a point: μ_r falls as μ_t rises"));
  result.correlation = {{1, 0}, {0, 1}};
  EXPECT_THAT(ConclusionOf(campaign::ResultText(result)).verdict, HasSubstr("determine a point"));
  result.posterior->branches.push_back(
      {.share = 0.1, .values = {0.8, 0.4}, .low = {0.7, 0.3}, .high = {0.9, 0.5}});
  const Conclusion conclusion = ConclusionOf(campaign::ResultText(result));
  EXPECT_THAT(conclusion.verdict, HasSubstr("2 separate answers"));
  ASSERT_EQ(conclusion.branches.size(), 2u);
  EXPECT_EQ(conclusion.branches[1].values, std::vector<double>({0.8, 0.4}));
  result.posterior.reset();
  EXPECT_EQ(ConclusionOf(campaign::ResultText(result)).verdict, "");
}

TEST_F(Report, PageHoldsTheVerdictAndItsBranches) {
  ReportData data = Data();
  data.evidence.conclusion = ConclusionOf(campaign::ResultText(ResultWithPosterior()));
  const json headline = json::parse(PageJson(data))["headline"];
  EXPECT_EQ(headline["verdict"], data.evidence.conclusion->verdict);
  EXPECT_EQ(headline["branches"][0]["high"], json({0.4, 0.2}));
}

TEST(GatherEvidence, NamesAFolderWithoutACampaign) {
  EXPECT_THROW(GatherEvidence(testing::TempDir() + "/no campaign"), base::ConfigError);
}

}  // namespace
}  // namespace talus::analysis
