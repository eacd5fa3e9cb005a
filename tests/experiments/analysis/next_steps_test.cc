// What a report says to do next, and what of it is asked for.
#include "experiments/analysis/report/views/next_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
#include "base/text/number_text.h"
#include "experiments/analysis/report/data/methods.h"
#include "experiments/analysis/report/data/report_data.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/page/summary.h"
#include "experiments/analysis/report/write_report.h"
#include "tests/experiments/scratch_folder.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace next_steps_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A valley is left open by more of the same; and no instrument tells the friction of two grains.
TEST(NextSteps, ADifferentTestComesFirstWhereACurveIsLeft) {
  const Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  const std::vector<NextStep> steps = NextSteps(evidence, {});
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.front().what, "Add a different kind of test");
  for (const NextStep& step : steps) EXPECT_THAT(step.what, Not(StartsWith("Measure")));
  EXPECT_TRUE(NextSteps(test::MakeSyntheticCampaign({.num_trials = 12}), {}).empty());  // no model
}

// `talus next` without --simulate has judged what costs nothing only.
TEST(NextSteps, ADifferentTestComesFirstWhereNoneHasBeenJudged) {
  const CandidateView runs{.kind = "more_runs",
                           .name = "more runs of heap",
                           .what = "photograph 5 more runs",
                           .bits = 0.1,
                           .width = {0.4, 0.4},
                           .remaining = 0.95,
                           .apart = {},
                           .apart_by = {},
                           .picture = {}};
  CandidateView wide = runs;
  wide.kind = "test";
  wide.bits = base::kNotKnown;
  const NextTableView table{.width = {0.5, 0.4}, .candidates = {runs, wide}};
  const std::vector<NextStep> steps =
      NextSteps(test::MakeSyntheticCampaign({.num_parameters = 2}), table);
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.front().what, "Add a different kind of test");
}

// What an alarm wants is the first step, whether `talus next` was run or not.
TEST(NextSteps, SimulationsThatAnAlarmAsksForComeFirst) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.answer->warnings.push_back(
      {.kind = campaign::AlarmKind::kPoorModel, .value = 0.5, .widened = 2});
  const CandidateView wide{.kind = "test",
                           .name = "wide plate",
                           .what = "carry it out",
                           .bits = 3,
                           .width = {0.01, 0.01},
                           .remaining = 1e-4,
                           .apart = {},
                           .apart_by = {},
                           .picture = {}};
  const NextTableView table{.width = {0.5, 0.4}, .candidates = {wide}};
  for (const std::optional<NextTableView>& known : {std::optional<NextTableView>(), {table}}) {
    const std::vector<NextStep> steps = NextSteps(evidence, known);
    ASSERT_GT(steps.size(), 1u);
    EXPECT_THAT(steps[0].what, StartsWith("Simulate more: talus resume"));
  }
}

// The budget ended a search whose region was still the surrogate's: a different test would begin
// where that is not known.
TEST(NextSteps, SimulationsComeFirstWhileTheRegionMayMove) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  campaign::Answer& answer = *evidence.answer;
  answer.stop = {.kind = campaign::StopKind::kSimulations, .value = 8};
  answer.unsettled.emplace().lacks = optimizer::StopLack::kFirstTrials;
  answer.posterior->surrogate_narrowing = 0.79;
  std::vector<NextStep> steps = NextSteps(evidence, {});
  ASSERT_GT(steps.size(), 1u);
  EXPECT_THAT(steps[0].what, StartsWith("Simulate more: talus resume"));
  EXPECT_EQ(steps[0].leaves, "ranges narrower by up to 79 %");
  answer.unsettled = {.lacks = optimizer::StopLack::kShare,
                      .narrowing = {{.parameter = "sliding_friction", .share = 0.4}},
                      .num_more = 20};
  steps = NextSteps(evidence, {});
  EXPECT_THAT(steps[0].what, StartsWith("Simulate more: talus resume"));
  EXPECT_EQ(steps[0].leaves, "ranges narrower by 40 % of sliding_friction");
  answer.posterior->surrogate_narrowing = 0.2;  // the measurements leave more open
  EXPECT_EQ(NextSteps(evidence, {})[0].what, "Add a different kind of test");
}

// Given the first parameter, the bent valley of the synthetic posterior leaves little of the
// second.
TEST(NextSteps, MeasuringTheFrictionOfThePlateLeavesANarrowRangeOfTheOther) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.parameters[0].range.name = "plate_sliding_friction";
  const std::vector<NextStep> steps = NextSteps(evidence, {});
  const auto measured = std::find_if(steps.begin(), steps.end(), [](const NextStep& step) {
    return step.what.starts_with("Measure μₜ on a tilted plate");
  });
  ASSERT_NE(measured, steps.end());
  // The valley is 0.02 thick and 0.6 long, so knowing one leaves less than a tenth of the area.
  EXPECT_LT(measured->remaining, 0.1);
  // What it leaves stands beside the very range that the page shows.
  const campaign::ResultParameter& shown = evidence.answer->parameters[1];
  EXPECT_THAT(measured->leaves,
              HasSubstr("(now " + base::ShortNumber(shown.credible_low, 3) + " to " +
                        base::ShortNumber(shown.credible_high, 3) + ")"));
}

TEST(NextSteps, NumbersAreMeasuredAgainAndNotPhotographed) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.reference.aehp = {};
  evidence.answer->experiments[0].has_image = false;
  std::string all;
  for (const NextStep& step : NextSteps(evidence, {})) all += step.what + "; ";
  EXPECT_THAT(all, HasSubstr("Repeat the measurement"));
  EXPECT_THAT(all, Not(HasSubstr("Photograph")));
  EXPECT_THAT(MethodsText(MakeReportData(evidence)), Not(HasSubstr("images")));
}

TEST(Nuisances, AreSaidNotToBeAskedFor) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.parameters[1].range.is_nuisance = true;
  const ReportData data = MakeReportData(evidence);
  EXPECT_EQ(json::parse(PageJson(data))["parameters"][1]["nuisance"], true);
  EXPECT_THAT(SummaryPage(data), HasSubstr(", not asked for</td>"));
  const std::string text = MethodsText(data);
  EXPECT_NE(text.find("(integrated out)"), std::string::npos);
  EXPECT_EQ(text.find("(integrated out)"), text.rfind("(integrated out)"));
}

// Nobody asks for a nuisance itself: where the others do not hang on it, to measure it is no step.
TEST(NextSteps, ANuisanceThatLeavesTheOthersAsTheyAreIsNotToBeMeasured) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.parameters[0].range.name = "plate_pair_sliding_friction";
  Eigen::MatrixXd& draws = evidence.model->draws;
  const Eigen::Index half =
      draws.rows() / 2;  // moved past each other, they tell nothing of each other
  Eigen::VectorXd moved(draws.rows());
  for (Eigen::Index i = 0; i < draws.rows(); ++i)
    moved[i] = draws((i * 7919 + half) % draws.rows(), 1);
  draws.col(1) = moved;
  const auto is_offered = [&] {
    const std::vector<NextStep> steps = NextSteps(evidence, {});
    return std::any_of(steps.begin(), steps.end(),
                       [](const NextStep& step) { return step.what.starts_with("Measure"); });
  };
  EXPECT_TRUE(is_offered());
  evidence.answer->parameters[0].nuisance.emplace();
  EXPECT_FALSE(is_offered());
}

// A sheet with the former answer stood beside a page that had none.
TEST(Sheet, OfASearchThatGoesOnIsGone) {
  const ScratchFolder scratch;
  const std::filesystem::path sheet = scratch.path() / "report/summary.html";
  ReportData data = MakeReportData(test::MakeSyntheticCampaign());
  ASSERT_TRUE(data.evidence.answer.has_value());
  WriteReport(data, scratch.path() / "report");
  EXPECT_TRUE(std::filesystem::exists(sheet));
  data.evidence.answer.reset();
  WriteReport(data, scratch.path() / "report");
  EXPECT_FALSE(std::filesystem::exists(sheet));
}

}  // namespace next_steps_test
}  // namespace talus::analysis
