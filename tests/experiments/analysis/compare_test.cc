#include "experiments/analysis/compare/compare.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/not_known.h"
#include "experiments/analysis/compare/compare_tables.h"
#include "experiments/campaign/record/reference.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace compare_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Sample {
  double x = 0;         // the one parameter, which is also its unit coordinate
  double quantity = 0;  // of the metric
};

// One parameter from 0 to 1 and one metric.
Evidence OneParameter(const std::string& metric, const std::vector<Sample>& samples,
                      double reference = base::kNotKnown) {
  Evidence evidence;
  evidence.parameters.resize(1);
  evidence.parameters[0].range.low = 0;
  evidence.parameters[0].range.high = 1;
  evidence.metrics = {{metric, ""}};
  evidence.reference.aehp.image = {.width = 1, .height = 1, .pixels = {0}};
  evidence.reference.metrics = {reference};
  for (const Sample& sample : samples) {
    TrialEvidence trial;
    trial.id = static_cast<int>(evidence.trials.size()) + 1;
    trial.point = Eigen::VectorXd::Constant(1, sample.x);
    trial.values = {sample.x};
    trial.metrics = {sample.quantity};
    evidence.trials.push_back(trial);
  }
  return evidence;
}

ObjectiveFinding Find(const Evidence& evidence, std::string_view key) {
  for (ObjectiveFinding& finding : CompareObjectives(evidence)) {
    if (finding.info.key == key) return finding;
  }
  throw std::out_of_range("no such objective");
}

TEST(Objectives, NameTheirMetricAndTheirValue) {
  EXPECT_EQ(base::NameOf(journal::Objective::kRmse), "rmse");
  EXPECT_EQ(journal::InfoOf(journal::Objective::kRmse).ValueKey(), "rmse_gray");
  EXPECT_EQ(journal::InfoOf(journal::Objective::kAor2).metric, "repose_angle_2_mean_deg");
  EXPECT_EQ(journal::InfoOf(journal::Objective::kAor2).ValueKey(), "aor2_difference_deg");
  EXPECT_EQ(journal::InfoOf(journal::Objective::kAor2).Value(31, 34), 3);
}

TEST(CompareObjectives, TakesRepeatsAsOneSetWithTheirMean) {
  const auto finding =
      Find(OneParameter("sad_mm2", {{0.2, 1.0}, {0.6, 4.5}, {0.6, 5.5}, {0.9, 7.0}}), "sad");
  ASSERT_EQ(finding.from_trials.best.size(), 3u);
  EXPECT_EQ(finding.from_trials.best[1].quantity, 5.0);
  EXPECT_THAT(finding.from_trials.best[1].trials, ElementsAre(2, 3));
}

TEST(CompareObjectives, ScatterIsThatOfTheRepeats) {
  // Two sets with two repeats each: s² = (0.5 + 2) / 2 degrees of freedom.
  const auto finding =
      Find(OneParameter("sad_mm2", {{0.2, 1.0}, {0.2, 2.0}, {0.6, 5.0}, {0.6, 7.0}}), "sad");
  EXPECT_DOUBLE_EQ(finding.noise_sd, std::sqrt(2.5 / 2));
}

// Two heaps alike by chance, all that was simulated again: the other sets show how values scatter.
TEST(CompareObjectives, OneRepeatAloneIsNotTheScatter) {
  std::vector<Sample> samples;
  for (int i = 0; i <= 12; ++i) samples.push_back({i / 12.0, 5.0 + (i % 2 == 0 ? 0.5 : -0.5)});
  samples.push_back({0.5, 5.51});
  const Evidence evidence = OneParameter("sad_mm2", samples);
  const double sd = Find(evidence, "sad").noise_sd;
  EXPECT_GT(sd, 0.2);
  // The report's, which asks for no best set of a model.
  const auto of_trials = CompareTrials(evidence);
  const auto sad = std::ranges::find(of_trials, std::string_view("sad"),
                                     [](const ObjectiveFinding& f) { return f.info.key; });
  ASSERT_NE(sad, of_trials.end());
  EXPECT_EQ(sad->noise_sd, sd);
  EXPECT_FALSE(sad->from_model);
}

// "Sets tie when they differ by at most the scatter of one simulation: SAD 0 mm²."
TEST(CompareObjectives, SeedsThatChangeNothingAreSaidToDoSo) {
  const auto text = [](double second) {
    const Evidence evidence = OneParameter("sad_mm2", {{0.2, 1.0}, {0.2, second}, {0.6, 5.0}});
    return ComparisonText({evidence, CompareObjectives(evidence)});
  };
  EXPECT_THAT(text(1.0), HasSubstr("came out alike: only equal sets tie"));
  EXPECT_THAT(text(2.0), HasSubstr("scatter of one simulation: SAD 0.71 mm²."));
}

TEST(CompareObjectives, SaysThatItsTrialsAreOfCoarserGrainsThanTheAnswer) {
  Evidence evidence = OneParameter("sad_mm2", {{0.2, 1.0}, {0.6, 5.0}});
  evidence.experiments = {"heap"};
  EXPECT_THAT(ComparisonText({evidence, CompareObjectives(evidence)}),
              Not(HasSubstr("scale factor")));
  evidence.scale_factor = 3;
  for (TrialEvidence& trial : evidence.trials) trial.scale_factor = 3;
  const auto findings = CompareObjectives(evidence);
  EXPECT_THAT(ComparisonText({evidence, findings}),
              HasSubstr("at the scale factor 3, with its bias; the campaign's answer is for 1."));
  EXPECT_THAT(ComparisonJson({evidence, findings}), HasSubstr("\"target_scale_factor\": 1"));
}

TEST(CompareObjectives, RanksAnAngleByItsDistanceFromTheExperiments) {
  const auto finding = Find(
      OneParameter("repose_angle_2_mean_deg", {{0.1, 20}, {0.5, 31}, {0.9, 29.5}}, 30), "aor2");
  EXPECT_EQ(finding.from_trials.best[0].quantity, 29.5);
  EXPECT_EQ(finding.from_trials.best[0].objective, 0.5);
  EXPECT_EQ(finding.from_trials.best[1].quantity, 31);
}

TEST(CompareObjectives, TiedVolumeIsThatNearestToTheTiedSets) {
  // Ten sets in the middles of ten equal cells; the scatter 0.5 makes 1, 1.2 and 1.45 tie.
  std::vector<Sample> samples{{0.05, 0.75}, {0.05, 1.25 + 0.20710678}};
  samples[0].quantity = 1 - 0.5 / std::sqrt(2.0);
  samples[1].quantity = 1 + 0.5 / std::sqrt(2.0);
  for (const double value : {1.2, 1.45, 1.6, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}) {
    samples.push_back({0.05 + 0.1 * (static_cast<double>(samples.size()) - 1), value});
  }
  const auto finding = Find(OneParameter("sad_mm2", samples), "sad");
  ASSERT_NEAR(finding.noise_sd, 0.5, 1e-12);
  EXPECT_EQ(finding.from_trials.num_tied, 3u);
  // An even sample of 4096 points misses a cell's border by less than one point.
  EXPECT_NEAR(finding.from_trials.tied_volume, 0.3, 1.0 / 2048);
}

TEST(CompareObjectives, ModelFindsTheMinimumBetweenTheTrialsAndItsTiedVolume) {
  std::vector<Sample> samples;
  for (int i = 0; i <= 12; ++i) {
    const double x = i / 12.0;
    samples.push_back({x, 1 + 10 * (x - 0.37) * (x - 0.37)});
  }
  samples.push_back({0.5, 1 + 10 * 0.13 * 0.13 + 0.02});  // a repeat: the scatter is 0.02 / √2
  const auto finding = Find(OneParameter("sad_mm2", samples), "sad");
  ASSERT_TRUE(finding.from_model);
  // The parabola's bottom is so flat that a hundredth in x is 1e-3 in value, a tenth of the
  // scatter.
  EXPECT_NEAR(finding.from_model->values[0], 0.37, 0.02);
  EXPECT_NEAR(finding.from_model->there.quantity, 1, 0.02);
  // 10 x² < scatter; the model's own error may shift each border by a few hundredths.
  const double half_width = std::sqrt(finding.margin() / 10);
  EXPECT_NEAR(finding.from_model->tied_volume, 2 * half_width, 0.03);
}

// The parabola's bottom is not allowed: the least is at the border nearest to it.
TEST(CompareObjectives, ModelsMinimumIsOneThatTheConstraintsAllow) {
  std::vector<Sample> samples;
  for (int i = 6; i <= 12; ++i) {
    const double x = i / 12.0;
    samples.push_back({x, 1 + 10 * (x - 0.37) * (x - 0.37)});
  }
  samples.push_back({0.5, 1 + 10 * 0.13 * 0.13 + 0.02});
  Evidence evidence = OneParameter("sad_mm2", samples);
  evidence.feasible = [](const Eigen::VectorXd& x) { return x[0] >= 0.5; };
  const auto finding = Find(evidence, "sad");
  ASSERT_TRUE(finding.from_model);
  EXPECT_GE(finding.from_model->values[0], 0.5);
  EXPECT_NEAR(finding.from_model->values[0], 0.5, 0.02);
}

TEST(CompareObjectives, SaysWhyAnObjectiveHasNoAnswer) {
  const Evidence evidence =
      OneParameter("repose_angle_1_mean_deg", {{0.1, 20}, {0.2, 21}}, base::kNotKnown);
  EXPECT_THAT(Find(evidence, "aor1").absent, HasSubstr("experiment"));
  EXPECT_THAT(Find(evidence, "sad").absent, HasSubstr("not measured"));
  EXPECT_THAT(Find(OneParameter("sad_mm2", {{0.1, base::kNotKnown}}), "sad").absent,
              HasSubstr("no trial"));
}

TEST(CompareObjectives, LeavesOutTrialsAtAnotherScaleAndFailures) {
  Evidence evidence = OneParameter("sad_mm2", {{0.1, 3}, {0.2, 2}, {0.3, 1}, {0.4, 0.5}});
  evidence.trials[2].scale_factor = 2;
  evidence.trials[3].state = journal::TrialStatus::kFailed;
  EXPECT_THAT(Find(evidence, "sad").from_trials.best[0].trials, ElementsAre(2));
}

// Values that a process puts below 0 are no perfect sets, and its least is one point, not many.
TEST(CompareObjectives, AModelNamesNoSetThatItDoesNotKnow) {
  std::vector<Sample> samples;
  for (int i = 0; i <= 12; ++i) samples.push_back({i / 12.0, std::abs(i - 5.5) / 3});
  samples.push_back({0.5, 0.5 / 3 + 0.001});  // a repeat: the scatter is nearly nothing
  const Evidence evidence = OneParameter("sad_mm2", samples);
  const auto finding = Find(evidence, "sad");
  ASSERT_TRUE(finding.from_model);
  EXPECT_GE(finding.from_model->there.objective, 0);
  EXPECT_NEAR(finding.from_model->values[0], 5.5 / 12, 0.05);
}

// One angle of two parameters and more is met along a curve: no set of it is named.
TEST(CompareObjectives, AnAngleOfSeveralParametersNamesNoSet) {
  const Evidence evidence = test::MakeSyntheticCampaign();
  const std::vector<ObjectiveFinding> findings = CompareObjectives(evidence);
  const auto angle = std::ranges::find(
      findings, "aor1", [](const ObjectiveFinding& finding) { return finding.info.key; });
  ASSERT_TRUE(angle != findings.end() && angle->from_model);
  EXPECT_NE(angle->from_model->withheld, "");
  EXPECT_THAT(ComparisonText({evidence, findings}),
              HasSubstr("AOR 1 has no set by a model: " + angle->from_model->withheld));
  EXPECT_THAT(ComparisonJson({evidence, findings}), HasSubstr("\"values\": null"));
}

// Why profiles are compared at all: one angle fits many heaps.
TEST(CompareObjectives, AnAngleOfReposeIsLessUniqueThanSad) {
  const Evidence evidence = test::MakeSyntheticCampaign();
  const auto sad = Find(evidence, "sad");
  const auto angle = Find(evidence, "aor1");
  EXPECT_GT(angle.from_model->tied_volume, 2 * sad.from_model->tied_volume);
  EXPECT_GT(angle.from_trials.tied_volume, sad.from_trials.tied_volume);
}

}  // namespace compare_test
}  // namespace talus::analysis
