// What an answer says first, and the sets that stand for it.
#include "experiments/campaign/answer/headline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/campaign/answer/alarms.h"
#include "experiments/campaign/answer/nuisances.h"
#include "tests/experiments/campaign/confirmed_answer.h"

namespace talus::campaign {
namespace headline_test {

using testing::HasSubstr;
using testing::SizeIs;

// Two searched parameters with their 90 % ranges; one branch.
Answer ResultWithRanges(double sliding_high, double energy_high) {
  Answer answer = ResultWithSet(0.1, 2e-6);
  answer.parameters[0].credible_low = 0.05;
  answer.parameters[0].credible_high = sliding_high;
  answer.parameters[1].credible_low = 1e-6;
  answer.parameters[1].credible_high = energy_high;
  answer.correlation = {{1, 0}, {0, 1}};
  answer.posterior.emplace().branches.resize(1);
  return answer;
}

TEST(Headline, SaysWhatIsNotDeterminedBeforeWhatIs) {
  Answer answer = ResultWithRanges(0.15, 9e-5);  // of the energy's two decades, 98 %
  EXPECT_THAT(Headline(answer, {"friction", "energy"})[0],
              HasSubstr("no simulation has confirmed"));
  answer.confirmed.resize(1);
  EXPECT_EQ(VerdictKindOf(answer), VerdictKind::kRegion);
  const auto sentences = Headline(answer, {"friction", "energy"});
  ASSERT_THAT(sentences, SizeIs(4));
  EXPECT_EQ(sentences[0], "Sets are found that fit every measurement.");
  EXPECT_THAT(sentences[1], HasSubstr("do not determine energy: nearly every searched value fits"));
  EXPECT_EQ(sentences[2], "They determine friction 0.1 (90 %: 0.05 to 0.15).");
  EXPECT_THAT(sentences[3], HasSubstr("a region, not a point"));
}

// "0.00145 mg": a million times too little.
TEST(Headline, ASearchedMassIsInTheUnitThatItSays) {
  Answer answer = ResultWithRanges(0.15, 9e-5);
  answer.parameters[0] = {.name = "mass",
                          .unit = "kg",
                          .value = 1.5e-3,
                          .searched_low = 1e-3,
                          .searched_high = 3e-3,
                          .credible_low = 1.45e-3,
                          .credible_high = 1.55e-3};
  answer.confirmed.resize(1);
  EXPECT_THAT(HeadlineText(answer), HasSubstr("mass 0.0015 kg (90 %: 0.00145 to 0.00155 kg)"));
  answer.parameters[0].nuisance.emplace();
  EXPECT_THAT(NuisanceText(answer.parameters[0], "mass"), HasSubstr("0.00145 … 0.00155 kg,"));
}

// Measured twice, an angle may be anything by chance: "Sets are found that fit every measurement"
// was said of 5° for 28°.
TEST(Headline, WhatFewSimulationsLeaveOpenIsNoFit) {
  Answer answer = ResultWithRanges(0.15, 9e-5);
  answer.experiments = {
      {.name = "funnel heap",
       .numbers = {
           {.name = "angle_of_repose_1_deg", .value = 28.5, .standard_error = 0.5, .degrees = 1}}}};
  answer.confirmed.resize(1);
  answer.confirmed[0].experiments = {{.name = "funnel heap",
                                      .num_trials = 2,
                                      .scalars = {{.name = "angle_of_repose_1_deg",
                                                   .num_trials = 2,
                                                   .mean = 4.8,
                                                   .standard_error = 0.2,
                                                   .degrees = 1}}}};
  answer.posterior->experiments = {{.name = "funnel heap"}};
  EXPECT_THAT(HeadlineText(answer),
              HasSubstr("should confirm one do not tell for AOR 1 of \"funnel heap\"."));
  Answer held_out = answer;
  held_out.posterior->experiments = {{.name = "heap"}};
  EXPECT_THAT(HeadlineText(held_out), HasSubstr("Sets are found that fit every measurement."));
  answer.confirmed[0].experiments[0].scalars[0].mean = 29;
  EXPECT_THAT(HeadlineText(answer), HasSubstr("Sets are found that fit every measurement."));
}

TEST(Headline, SharesOfAllAndOfNearlyNothingAreReadable) {
  Answer answer = ResultWithRanges(0.95, 9e-5);
  answer.posterior->region_volume = 3e-7;
  EXPECT_THAT(HeadlineText(answer), HasSubstr("region fills less than 0.01 % of the searched"));
  answer.posterior->region_volume = 0.998;
  EXPECT_THAT(HeadlineText(answer), HasSubstr("region fills about 100 % of the searched"));
}

// A valley over the whole range determines one given the other.
TEST(Headline, OneOfATiedPairIsNotCalledOpen) {
  Answer answer = ResultWithRanges(0.95, 9e-5);
  answer.correlation = {{1, -0.95}, {-0.95, 1}};
  EXPECT_EQ(VerdictKindOf(answer), VerdictKind::kCurve);
  const std::string text = HeadlineText(answer);
  EXPECT_EQ(text.find("do not determine"), std::string::npos) << text;
  EXPECT_THAT(text, HasSubstr("They determine sliding_friction given surface_energy, not both"));
}

TEST(Headline, WhereNoSetFitsNothingIsSaidToFit) {
  Answer answer = ResultWithRanges(0.15, 2e-6);
  for (const AlarmKind kind : {AlarmKind::kImplausible, AlarmKind::kDisagree, AlarmKind::kMisses}) {
    answer.warnings = {{.kind = kind}};
    const auto sentences = Headline(answer, {"friction", "energy"});
    EXPECT_EQ(sentences[0].find("Sets are found"), std::string::npos);
    EXPECT_EQ(sentences.back().find("region fills"), std::string::npos);
  }
}

TEST(Verdict, EndsOfABentValleyAreItsRepresentatives) {
  Eigen::MatrixXd valley(500, 2);
  for (Eigen::Index i = 0; i < valley.rows(); ++i) {
    const double along = static_cast<double>(i) / 499;
    valley.row(i) << 0.1 + 0.8 * along, 0.9 - 0.8 * along * along;
  }
  const Eigen::Vector2d recommended(0.5, 0.7);
  const auto sets = RepresentativeSets(valley, recommended, {0, 1});
  ASSERT_EQ(sets.size(), 3u);
  EXPECT_EQ(sets[1], recommended);
  // Each end is the middle of the points between the outermost 4 % and 12 %, some 0.07 of the way.
  const double from = std::min(sets[0][0], sets[2][0]);
  const double to = std::max(sets[0][0], sets[2][0]);
  EXPECT_NEAR(from, 0.16, 0.03);
  EXPECT_NEAR(to, 0.84, 0.03);
  EXPECT_THAT(RepresentativeSets(0.1 * valley, recommended, {0, 1}), SizeIs(1));
}

TEST(Candidates, EndsOfAValleyAreConfirmedAfterRecommendedSetAndBranches) {
  Eigen::MatrixXd valley(500, 2);
  for (Eigen::Index i = 0; i < valley.rows(); ++i) {
    const double along = static_cast<double>(i) / 499;
    valley.row(i) << 0.1 + 0.8 * along, 0.9 - 0.8 * along;
  }
  optimizer::Answer answer;
  answer.point = Eigen::Vector2d(0.5, 0.5);
  answer.posterior.emplace().branches.emplace_back().point = answer.point;
  const auto candidates = CandidatesOf(answer, {valley, {0, 1}}, {.candidates = 1});
  ASSERT_THAT(candidates, SizeIs(3));
  EXPECT_EQ(candidates[0].role, CandidateRole::kRecommended);
  EXPECT_EQ(candidates[1].role, CandidateRole::kEnd);
  EXPECT_EQ(candidates[2].role, CandidateRole::kEnd);
  EXPECT_THAT(CandidatesOf(answer, {valley, {0, 1}}, {.candidates = 1, .ends = false}), SizeIs(1));
  EXPECT_THAT(CandidatesOf(answer, {0.1 * valley, {0, 1}}, {.candidates = 1}),
              SizeIs(1));  // a point
  EXPECT_EQ((ConfirmOptions{.candidates = 1, .replicates = 3}.MostTrials()), 9);
  EXPECT_EQ((ConfirmOptions{.candidates = 0, .replicates = 3}.MostTrials()), 0);
}

TEST(Headline, HalfOfARangeIsARegionAndNotOpen) {
  Answer answer;
  answer.parameters = {{.name = "friction",
                        .value = 0.5,
                        .searched_low = 0,
                        .searched_high = 1,
                        .credible_low = 0.1,
                        .credible_high = 0.8}};
  answer.correlation = {{1}};
  answer.posterior.emplace().branches.resize(1);
  answer.confirmed.resize(1);
  EXPECT_THAT(HeadlineText(answer), testing::Not(HasSubstr("do not determine")));
  answer.parameters[0].credible_high = 0.91;
  EXPECT_THAT(HeadlineText(answer), HasSubstr("do not determine friction"));
}

}  // namespace headline_test
}  // namespace talus::campaign
