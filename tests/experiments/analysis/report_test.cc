#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/analysis/report/data/methods.h"
#include "experiments/analysis/report/data/tables.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/views/answer_words.h"
#include "experiments/analysis/report/views/model_views.h"
#include "experiments/analysis/report/write_report.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/answer/joint_view.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/metrics.h"
#include "tests/experiments/synthetic_campaign.h"
#include "tests/experiments/synthetic_journal.h"

namespace talus::analysis {
namespace report_test {

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

TEST(PageTemplate, WhatIsPutInIsNotSearchedForPlaceholders) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_trials = 4});
  evidence.name = "{{js}} {{data}} {{none}}";
  const std::string page = ReportPage(MakeReportData(evidence));
  EXPECT_THAT(page, HasSubstr("<title>{{js}} {{data}} {{none}} – calibration report</title>"));
  const auto from = page.find("id=\"data\">") + std::string("id=\"data\">").size();
  const json data = json::parse(page.substr(from, page.find("</script>", from) - from));
  EXPECT_EQ(data["campaign"]["name"], evidence.name);
}

// A distance from the measured angle must not read as the angle.
TEST(PageHead, ADistanceFromTheMeasurementIsCalledOne) {
  Evidence evidence = test::MakeSyntheticCampaign();
  const auto titles = [&] {
    const json page = json::parse(PageJson(MakeReportData(evidence)));
    EXPECT_EQ(page["campaign"]["objective"]["value_title"], page["headline"]["objective_title"]);
    return page["headline"]["objective_title"];
  };
  EXPECT_EQ(titles(), "SAD");
  evidence.objective = "aor2";
  EXPECT_EQ(titles(), "AOR 2, off by");
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
  EXPECT_THAT(best, StartsWith("objective,rank,unit,quantity,"));
  EXPECT_THAT(Table("objectives"), HasSubstr("\nsad,trials,sad_mm2,mm2,"));
  EXPECT_EQ(std::count(best.begin(), best.end(), '\n'), 1 + 5 * 10);
}

TEST(PageHead, CountsTheTrialsOfAllExperiments) {
  Evidence evidence = test::MakeSyntheticCampaign();
  const auto head = [&] { return json::parse(PageJson(MakeReportData(evidence)))["campaign"]; };
  const json alone = head();
  evidence.of_others.assign(2, TrialEvidence{});
  for (TrialEvidence& other : evidence.of_others) {
    other.state = journal::TrialStatus::kOk;
    other.kind = journal::TrialKind::kSearch;
  }
  evidence.of_others[1].kind = journal::TrialKind::kConfirm;
  const json both = head();
  EXPECT_EQ(both["counts"]["searched"], alone["counts"]["searched"].get<int>() + 1);
  EXPECT_EQ(both["counts"]["confirming"], alone["counts"]["confirming"].get<int>() + 1);
}

TEST_F(Report, OutlinesOfTheExperimentAreMarked) {
  const json outlines = json::parse(PageJson(Data()))["outlines"];
  ASSERT_GT(outlines.size(), 1u);
  for (const json& outline : outlines) {
    EXPECT_EQ(outline["experiment"], outline["title"] == "experiment (AEHP)");
  }
}

TEST_F(Report, OutlinesEndOnThePlateWithinIt) {
  ASSERT_FALSE(Data().outlines.empty());
  for (const OutlineCurve& outline : Data().outlines) {
    ASSERT_GT(outline.x.size(), 10u);
    EXPECT_EQ(outline.height.front(), 0);
    EXPECT_EQ(outline.height.back(), 0);
    // The heap is shifted by up to some pixels of 60 µm.
    EXPECT_NEAR(outline.x.front(), -0.005, 3e-4);
    EXPECT_NEAR(outline.x.back(), 0.005, 3e-4);
  }
}

// What the page says of the objective at the recommended set is what the model that answers says.
TEST_F(Report, SlicesPassThroughTheAnswerOfTheModelThatAnswered) {
  const ReportData& data = Data();
  ASSERT_EQ(data.slices.size(), 3u);
  for (const ModelSlice& slice : data.slices) {
    EXPECT_GE(*std::min_element(slice.mean.begin(), slice.mean.end()), 0);
    EXPECT_GE(*std::min_element(slice.low.begin(), slice.low.end()), 0);
    // The synthetic answer recommends the truth; 60 steps of the range pass within half a step.
    const double there = data.evidence.answer->parameters[slice.parameter].value;
    const auto at = std::min_element(slice.x.begin(), slice.x.end(), [&](double a, double b) {
      return std::abs(a - there) < std::abs(b - there);
    });
    Eigen::VectorXd truth(3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      truth[k] = data.evidence.parameters[i].range.ToUnit(test::SyntheticTruth()[i]);
    }
    const double expected = data.evidence.model->predict(truth.transpose()).mean[0];
    EXPECT_NEAR(slice.mean[static_cast<std::size_t>(at - slice.x.begin())], expected, 0.3);
  }
}

// The posterior is drawn from its draws; nothing is fitted to the trials beside it.
TEST_F(Report, RegionsOfTwoAreTheShadowOfTheJointOne) {
  const ReportData& data = Data();
  ASSERT_EQ(data.marginals.size(), 3u);
  ASSERT_EQ(data.pairs.size(), 3u);
  const PairMap& pair = data.pairs[0];
  const auto cells = static_cast<Eigen::Index>(pair.x_edges.size()) - 1;
  const Eigen::MatrixXd& draws = data.evidence.model->draws;
  double inside_half = 0, inside_most = 0;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const auto cell_of = [&](double unit) {
      return std::min(static_cast<Eigen::Index>(unit * static_cast<double>(cells)), cells - 1);
    };
    const double level =
        pair.value[static_cast<std::size_t>(cell_of(draws(i, 1)) * cells + cell_of(draws(i, 0)))];
    inside_half += level < 0.5 ? 1 : 0;
    inside_most += level < 0.9 ? 1 : 0;
  }
  // The shadow of a ball that holds half of three normal variables (squared radius 2.37) holds 0.69
  // of two of them; of one that holds 0.9 (6.25), 0.956. 1000 draws count to ± 0.016, and each
  // reaches somewhat beyond itself.
  EXPECT_NEAR(inside_half / 1000, 0.74, 0.08);
  EXPECT_NEAR(inside_most / 1000, 0.96, 0.04);
  const auto outside = std::count_if(pair.value.begin(), pair.value.end(),
                                     [](double level) { return level >= 0.9; });
  // The valley is 0.02 thick and about 0.6 long; smeared with one width for all it would fill half.
  EXPECT_GT(outside, 0.8 * static_cast<double>(pair.value.size()));
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
  ASSERT_TRUE(read.answer);
  EXPECT_EQ(campaign::AnswerJson(*read.answer), campaign::AnswerJson(*made.answer));

  const auto page = WriteReport(MakeReportData(read), folder / "report");
  EXPECT_THAT(base::ReadFile(page), HasSubstr("Ti6Al4V"));
  EXPECT_TRUE(std::filesystem::exists(folder / "report" / "tables" / "trials.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "report" / "figures" / "aehp.png"));
  std::filesystem::remove_all(folder);
}

// The verdict's own words are tested beside it; the page adds symbols to the names.
TEST_F(Report, PageHoldsTheHeadlineWithSymbolsAndTheBranches) {
  const json page =
      json::parse(PageJson(MakeReportData(test::MakeSyntheticCampaign({.num_parameters = 2}))));
  const json& headline = page["headline"];
  EXPECT_EQ(headline["verdict_kind"], "curve");
  EXPECT_EQ(headline["sentences"][0], "Sets are found that fit every measurement.");
  EXPECT_THAT(headline["sentences"].back().get<std::string>(),
              HasSubstr("rolling friction μᵣ given sliding friction μₜ, not both"));
  EXPECT_EQ(headline["branches"].size(), 1u);
  EXPECT_EQ(headline["fits"], true);
  EXPECT_THAT(page["warnings"][0].get<std::string>(), HasSubstr("are known together only"));
}

TEST_F(Report, AMissIsSaidFirstAndNothingIsSaidToFit) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.answer->warnings = {
      {.kind = campaign::AlarmKind::kMisses, .experiment = "heap", .value = 2.6}};
  const json page = json::parse(PageJson(MakeReportData(evidence)));
  EXPECT_THAT(page["headline"]["sentences"][0].get<std::string>(),
              StartsWith("The recommended set misses a measurement"));
  EXPECT_EQ(page["headline"]["fits"], false);
  EXPECT_THAT(page["headline"]["use"].get<std::string>(), StartsWith("No: "));
}

// Before a set is simulated again, the heap beside the photographs is the best by the campaign's
// own objective; it was the best by SAD.
TEST_F(Report, TheFirstHeapIsTheBestByTheObjective) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  std::erase_if(evidence.trials, [](const TrialEvidence& trial) {
    return trial.kind == journal::TrialKind::kConfirm;
  });
  evidence.answer.reset();
  evidence.objective = "aor2";
  const ReportData data = MakeReportData(evidence);
  const int best = data.own().from_trials.best.front().trials.front();
  ASSERT_NE(best, data.findings[0].from_trials.best.front().trials.front());
  EXPECT_EQ(data.overlay.trial->id, best);
}

TEST(AnswerWords, PowersOfTenAreThoseOfPrint) {
  EXPECT_EQ(WithPowers("γ 3e-05 (90 %: 2.35e-05 to 1e+12)."),
            "γ 3 × 10⁻⁵ (90 %: 2.35 × 10⁻⁵ to 1 × 10¹²).");
  EXPECT_EQ(WithPowers("the 2e grade, scale-5"), "the 2e grade, scale-5");
}

TEST(Labels, TheWordsDoNotSayTheBodyThatTheSymbolNames) {
  EXPECT_EQ(LongNameOf("sliding_friction"), "sliding friction μₜ");
  EXPECT_EQ(LongNameOf("plate_pair_sliding_friction"), "sliding friction μₜ powder–plate");
  EXPECT_EQ(LongNameOf("tube_surface_energy"), "surface energy γ tube");
  EXPECT_EQ(LongNameOf("hopper_angle"), "hopper_angle");
}

// ".." would be the folder above.
TEST(WriteReport, TablesOfFurtherExperimentsStandInFoldersOfTheirOwn) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "talus_report_tables";
  std::filesystem::remove_all(folder);
  std::vector<Evidence> others(2,
                               test::MakeSyntheticCampaign({.num_trials = 4, .concluded = false}));
  Evidence shown = others[0];
  for (std::size_t i = 0; i < 2; ++i) others[i].experiment = i + 1;
  shown.experiments = others[0].experiments = others[1].experiments = {"heap", "wide plate", ".."};
  others[0].trials.pop_back();
  WriteReport(MakeReportData(shown, others), folder);
  const auto lines = [&](const char* file) {
    const std::string text = base::ReadFile(folder / "tables" / file);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("trials.csv"), 5);
  EXPECT_EQ(lines("wide plate/trials.csv"), 4);
  EXPECT_EQ(lines("experiment_3/trials.csv"), 5);
  EXPECT_FALSE(std::filesystem::exists(folder / "trials.csv"));
  // One that has another name since; a file of the user's keeps its folder.
  base::WriteFileAtomically(folder / "tables/experiment_3/mine.txt", "mine");
  shown.experiments = others[0].experiments = others[1].experiments = {"heap", "wide", "third"};
  WriteReport(MakeReportData(shown, others), folder);
  EXPECT_FALSE(std::filesystem::exists(folder / "tables/wide plate"));
  EXPECT_FALSE(std::filesystem::exists(folder / "figures/wide plate"));
  EXPECT_FALSE(std::filesystem::exists(folder / "tables/experiment_3/trials.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "tables/experiment_3/mine.txt"));
  EXPECT_EQ(lines("wide/trials.csv"), 4);
  std::filesystem::remove_all(folder);
}

// Nobody works on the folder that a test has written.
TEST(GatherEvidence, ACampaignThatWasKilledIsNotRunning) {
  const auto folder = std::filesystem::temp_directory_path() / "talus_killed_campaign_test";
  std::filesystem::remove_all(folder);
  test::WriteSyntheticJournal(test::MakeSyntheticCampaign({.num_trials = 20, .concluded = false}),
                              folder);
  const Evidence evidence = GatherEvidence(folder, "");
  EXPECT_TRUE(evidence.ended_silently);
  EXPECT_FALSE(evidence.IsRunning());
  EXPECT_EQ(json::parse(PageJson(MakeReportData(evidence)))["campaign"]["ended_silently"], true);
  EXPECT_TRUE(std::isnan(evidence.seconds_left));
  std::filesystem::remove_all(folder);
}

// `talus compare --objective` leaves a result of another objective than the spec's.
TEST(GatherEvidence, TheModelIsOfTheObjectiveThatTheResultIsOf) {
  const auto folder = std::filesystem::temp_directory_path() / "talus_other_objective_test";
  std::filesystem::remove_all(folder);
  Evidence evidence = test::MakeSyntheticCampaign({.num_trials = 20});
  ASSERT_EQ(evidence.objective, "sad");
  evidence.answer->objective = "aor2_difference_deg";
  test::WriteSyntheticJournal(evidence, folder);
  EXPECT_EQ(campaign::ReadJointView(folder).spec.objective, journal::Objective::kAor2);
  std::filesystem::remove_all(folder);
}

// It said "by the SAD" whatever was minimised.
TEST(Methods, NameTheObjectiveWhereNoPosteriorComparesTheImagesThemselves) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.fit = {{.experiment = "heap", .what = "shape", .measured = "5 heaps"}};
  EXPECT_THAT(MethodsText(MakeReportData(evidence)), HasSubstr("average profile. The strategy"));
  evidence.answer->posterior.reset();
  evidence.objective = "aor2";
  EXPECT_THAT(MethodsText(MakeReportData(evidence)), HasSubstr("average profile, by the AOR 2."));
}

TEST(Methods, SayWhatWasConfirmedAndCountWhatFailedAsChosen) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.answer->parameters[0].prior = {.text = "0.3 ± 0.1"};
  evidence.answer->confirmed.resize(1);
  evidence.fit = {{.experiment = "drum",
                   .what = "angle",
                   .simulated = "30.88° as the mean of 2 simulations; predicted 31.04 ± 0.2°",
                   .confirmed = "30.88° as the mean of 2 simulations",
                   .is_confirmed = true,
                   .held_out = true},
                  {.experiment = "heap", .what = "mass", .simulated = "predicted 5 ± 1 mg"}};
  const json page = json::parse(PageJson(MakeReportData(evidence)));
  const std::string methods = page["methods"];
  EXPECT_THAT(methods, HasSubstr("it gives 30.88° as the mean of 2 simulations (angle of \"drum\", "
                                 "held out)."));
  EXPECT_THAT(methods, HasSubstr("; prior 0.3 ± 0.1)"));
  EXPECT_THAT(methods, HasSubstr("failed."));
  EXPECT_THAT(methods, HasSubstr("of them failed."));
  EXPECT_EQ(page["headline"]["values"][0]["prior"], "0.3 ± 0.1");
}

TEST(GatherEvidence, NamesAFolderWithoutACampaign) {
  EXPECT_THROW(GatherEvidence(testing::TempDir() + "/no campaign"), base::ConfigError);
}

}  // namespace report_test
}  // namespace talus::analysis
