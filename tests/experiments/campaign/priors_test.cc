// What is known beforehand, and what is searched but not asked for, from the spec to the answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/json/json_file.h"
#include "base/random.h"
#include "experiments/analysis/card/card.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/campaign/earlier_posterior.h"
#include "experiments/campaign/spec/parameter_prior.h"
#include "experiments/campaign/start.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace priors_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

// What the fake engine gives at the truth: the balance tells the sliding friction alone, the tapped
// density the rolling friction alone.
constexpr const char* kFallen =
    R"({"name": "balance", "mass_fallen": {"value": "23 mg", "sd": "1 mg"}})";
constexpr const char* kTapped = R"({"name": "tapped",
  "rig": {"kind": "tapped_density", "diameter": "12 mm"}, "filling": {"kind": "pour"},
  "tapped_density": {"value": "1480 kg/m^3", "sd": "3 kg/m^3"}})";

struct Written {
  std::string experiments = kFallen;
  std::string sliding = R"("min": 0.1, "max": 0.8)";
  std::string rolling = R"("min": 0.05, "max": 0.5)";
  std::string more_parameters = {};
  std::string density = "2500 kg/m^3";
  int simulations = 24;
  double stop_share = 0.1;
};

class Priors : public CampaignFixture {
 protected:
  fs::path BeginWith(const std::string& name, const Written& w) const {
    const fs::path in = scratch_.path() / (name + "_in");
    WriteFakeSpec(in, "");
    std::ofstream(in / "spec.json") << R"({"experiments": [)" << w.experiments << R"(],
      "powder": {"sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g",
                 "material": {"density": ")"
                                    << w.density << R"("}},
      "coarse_graining": {"scale_factor": 2},
      "parameters": {"sliding_friction": {)"
                                    << w.sliding << R"(}, "rolling_friction": {)" << w.rolling
                                    << "}" << w.more_parameters << R"(},
      "budget": {"simulations": )" << w.simulations
                                    << R"(}, "posterior": {"stop_share": )" << w.stop_share
                                    << R"(}, "confirm": {"candidates": 1, "replicates": 2},
      "workers": 1})";
    BeginCampaign(in / "spec.json", scratch_.path() / name);
    return scratch_.path() / name;
  }
  Answer AnswerOf(const std::string& name, const Written& w) const {
    const fs::path folder = BeginWith(name, w);
    EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
    return Result(folder);
  }
  std::string ErrorOf(const Written& w) const {
    const std::string error = ErrorIn([&] { BeginWith("bad", w); });
    EXPECT_FALSE(fs::exists(scratch_.path() / "bad"));
    return error;
  }
};

double Of(const Answer& answer, std::size_t i, double ResultParameter::*field) {
  return answer.parameters.at(i).*field;
}

// Nothing is measured of the rolling friction, so that its posterior is its prior: with two ranges
// at once, 90 % lie within 1.95 sd.
TEST_F(Priors, WhatIsNotMeasuredKeepsItsPrior) {
  const Answer answer = AnswerOf(
      "kept", {.rolling = R"("min": 0.05, "max": 0.5, "prior": {"mean": 0.2, "sd": 0.02})"});
  EXPECT_NEAR(Of(answer, 1, &ResultParameter::credible_low), 0.2 - 1.95 * 0.02, 0.01);
  EXPECT_NEAR(Of(answer, 1, &ResultParameter::credible_high), 0.2 + 1.95 * 0.02, 0.01);
  ASSERT_TRUE(answer.parameters[1].prior);
  EXPECT_NEAR(answer.parameters[1].prior->low, 0.2 - 1.95 * 0.02, 0.004);  // as the posterior's
  EXPECT_LT(std::abs(answer.parameters[1].prior->offset), 0.3);
  EXPECT_FALSE(answer.parameters[0].prior);
  EXPECT_FALSE(HasAlarm(answer, {AlarmKind::kContradictsPrior}));
  EXPECT_THAT(AnswerSummary(answer, "kept"), HasSubstr("(prior 0.2 ± 0.02, 90 % in"));
  const ConsideredSet set = ConsiderSet(
      scratch_.path() / "kept", {{"sliding_friction", "0.45"}, {"rolling_friction", "0.2"}});
  EXPECT_THAT(ConsideredText(set), HasSubstr("rolling_friction: prior 0.2 ± 0.02, 90 % in"));
  const analysis::Card card = analysis::ReadCard(scratch_.path() / "kept");
  EXPECT_EQ(card.ranges[0].prior, "");
  EXPECT_EQ(card.ranges[1].prior, "0.2 ± 0.02");
}

TEST_F(Priors, AMeasurementThatContradictsThePriorIsAnAlarm) {
  const Answer answer = AnswerOf(
      "odd", {.sliding = R"("min": 0.1, "max": 0.8, "prior": {"median": 0.78, "factor": 1.15})",
              .simulations = 48});
  ASSERT_TRUE(HasAlarm(answer, {AlarmKind::kContradictsPrior}));
  EXPECT_LT(answer.parameters[0].prior->offset, -3);
  EXPECT_THAT(AnswerSummary(answer, "odd"), HasSubstr("contradict the prior of sliding_friction"));
}

// Heavy tails give in to a narrow prior, so that nothing moves away from it. A campaign that learns
// no more about the answer ends before its surrogate is sure that no set fits; the confirmation
// sees that the recommended one does not.
TEST_F(Priors, APriorThatKeepsEverySetFromFittingIsNamed) {
  const std::string held = R"("min": 0.1, "max": 0.8, "prior": {"mean": 0.75, "sd": 0.01})";
  const Answer early = AnswerOf("early", {.sliding = held, .simulations = 8});
  ASSERT_TRUE(HasAlarm(early, {AlarmKind::kMisses})) << AnswerSummary(early, "early");
  EXPECT_THAT(AnswerSummary(early, "early"),
              HasSubstr("before the prior of sliding_friction, the"));
  const Answer sure = AnswerOf("sure", {.sliding = held, .stop_share = 0.001});
  ASSERT_TRUE(HasAlarm(sure, {AlarmKind::kImplausible})) << AnswerSummary(sure, "sure");
  EXPECT_THAT(AnswerSummary(sure, "sure"), HasSubstr("off; the prior of sliding_friction, the"));
}

// The second test alone says nothing of what the first one has found.
TEST_F(Priors, AnEarlierPosteriorJoinsTwoCampaigns) {
  const Answer first = AnswerOf("first", {});
  const Answer joint =
      AnswerOf("joint", {.experiments = std::string(kFallen) + ", " + kTapped, .simulations = 48});
  const fs::path second = BeginWith(
      "second", {.experiments = kTapped, .more_parameters = R"(, "prior": {"from": "../first"})"});
  fs::remove_all(scratch_.path() / "first");  // the campaign has what it needs
  ASSERT_EQ(RunFake(second, {}), CampaignEnd::kFinished);
  const Answer answer = Result(second);
  for (const std::size_t i : {0u, 1u}) {
    const double width = joint.parameters[i].Width();
    const double range = joint.parameters[i].searched_high - joint.parameters[i].searched_low;
    EXPECT_NEAR(answer.parameters[i].value, joint.parameters[i].value, 0.5 * width * range);
    EXPECT_NEAR(std::log(answer.parameters[i].Width() / width), 0, std::log(1.5));
  }
  EXPECT_NEAR(std::log(answer.posterior->region_volume / joint.posterior->region_volume), 0,
              std::log(1.8));
  EXPECT_GT(first.parameters[1].Width(), 0.8);
}

// A campaign on the same photographs was narrowed by what it had itself found.
TEST_F(Priors, AnEarlierPosteriorOfTheSameMeasurementsCountsTwice) {
  AnswerOf("first", {});
  const auto warnings = [&](const std::string& name, Written w) {
    w.more_parameters = R"(, "prior": {"from": "../first"})";
    BeginWith(name, w);
    const auto file = base::ReadJsonFile(scratch_.path() / (name + "_in") / "spec.json");
    const CampaignSpec spec = ReadSpecWithPosteriors(file);
    return EarlierWarnings(spec, MakeRecord(spec, file));
  };
  EXPECT_THAT(warnings("again", {}), testing::ElementsAre(HasSubstr("which counts twice now")));
  EXPECT_THAT(warnings("other", {.experiments = kTapped}), testing::IsEmpty());
}

TEST_F(Priors, OfAnotherPowderOrOtherParametersAreRefused) {
  AnswerOf("first", {});
  const auto error_of = [&](Written w) {
    w.more_parameters = R"(, "prior": {"from": "../first"})";
    return ErrorOf(w);
  };
  EXPECT_THAT(error_of({.density = "4400 kg/m^3"}),
              HasSubstr("parameters.prior.from: is of another powder: its density is 2500"));
  EXPECT_THAT(error_of({.rolling = R"("fixed": 0.2)"}),
              HasSubstr("has found rolling_friction, which is not searched here"));
  EXPECT_THAT(error_of({.sliding = R"("min": 0.7, "max": 0.8)"}),
              HasSubstr("lies outside the ranges here for the most part"));
  EXPECT_THAT(ErrorOf({.more_parameters = R"(, "restitution": {"min": 0.3, "max": 0.9,
                                                "prior": {"from": "../first"}})"}),
              HasSubstr("parameters.restitution.prior.from: has not searched restitution"));
  BeginWith("begun", {});
  EXPECT_THAT(ErrorOf({.more_parameters = R"(, "prior": {"from": "../begun"})"}),
              HasSubstr("has no posterior yet"));
  EXPECT_THAT(ErrorOf({.more_parameters = R"(, "prior": {"from": "../nowhere"})"}),
              HasSubstr("is no folder of a campaign"));
}

// The fake heap does not depend on the restitution. The ranges of what is asked for are those of
// one parameter, not of three together.
TEST_F(Priors, ANuisanceIsSearchedAndNotAskedFor) {
  const Answer answer = AnswerOf(
      "with", {.rolling = R"("min": 0.05, "max": 0.5, "nuisance": true)",
               .more_parameters = R"(, "restitution": {"min": 0.3, "max": 0.95, "nuisance": true})",
               .simulations = 60});
  ASSERT_EQ(answer.parameters.size(), 3u);
  EXPECT_FALSE(answer.parameters[0].nuisance);
  ASSERT_TRUE(answer.parameters[2].nuisance);
  EXPECT_FALSE(Matters(answer.parameters[2]));
  EXPECT_THAT(NuisanceText(answer.parameters[2], "restitution"), HasSubstr("not determined, 0.3"));
  EXPECT_EQ(answer.verdict->kind, VerdictKind::kPoint);
  EXPECT_THAT(answer.verdict->text, HasSubstr("Not asked for: rolling_friction: not determined"));
  EXPECT_THAT(answer.verdict->text, HasSubstr("does not matter"));
  EXPECT_NEAR(answer.parameters[0].value, kTrueSliding, 0.05);
  const Answer alone = AnswerOf("alone", {.rolling = R"("fixed": 0.2)"});
  const double ratio = answer.parameters[0].Width() / alone.parameters[0].Width();
  // Nuisances that are told apart from it cost nothing but the noise of two searches, 10 % each.
  EXPECT_NEAR(std::log(ratio), 0, std::log(1.25));
  EXPECT_NEAR(std::log(answer.posterior->region_volume / alone.posterior->region_volume), 0,
              std::log(1.25));
  const fs::path folder = scratch_.path() / "with";
  const ConsideredSet set = ConsiderSet(folder, {{"sliding_friction", "0.45"}});
  EXPECT_LT(set.credible_level.value(), 0.9);
  EXPECT_THAT(ConsideredText(set), HasSubstr("restitution (nuisance): posterior 90 % in 0.3"));
}

// "nan … nan, does not matter"
TEST(NuisanceTexts, WithoutAModelThereIsNoRange) {
  ResultParameter p;
  p.nuisance.emplace();
  p.credible_low = p.credible_high = std::nan("");
  EXPECT_EQ(NuisanceText(p, "restitution"), "restitution: no range without a model");
}

// Heaps whose slope follows the rolling friction, and a nuisance that the map determines: its
// range says so, if the search goes on although nothing asked for gains by it. The mass that falls
// does not depend on it.
TEST_F(Priors, ADeterminedNuisanceIsCalledSo) {
  const Answer answer =
      AnswerOf("tapped", {.experiments = std::string(kFallen) + ", " + kTapped,
                          .rolling = R"("min": 0.05, "max": 0.5, "nuisance": true)",
                          .simulations = 48,
                          .stop_share = 0});
  EXPECT_THAT(NuisanceText(answer.parameters[1], "rolling_friction"),
              HasSubstr("rolling_friction: determined, 0."));
}

// Nothing is learnt: ranges that hold 90 % together were put beside the prior's of each by itself,
// which are narrower, and a third of its width could be learnt unseen.
TEST_F(Priors, RangesOfPriorAndPosteriorAreOfOneKind) {
  Written two;
  two.sliding += R"(, "prior": {"mean": 0.45, "sd": 0.05})";
  two.rolling += R"(, "prior": {"mean": 0.25, "sd": 0.03})";
  const CampaignSpec spec = ReadJointView(BeginWith("two", two)).spec;
  const optimizer::ParameterSpace space = SpaceOf(spec);
  optimizer::PosteriorSummary summary;
  base::Random random(1, base::Stream("draws of a prior"));
  summary.prior_draws.resize(4000, 2);
  for (double& draw : summary.prior_draws.reshaped()) draw = random.Uniform();
  summary.prior_offset = Eigen::Vector2d::Zero();
  const ResultPrior prior = PriorOf(summary, space, 0, *spec.parameters).value();
  // √0.9 of a uniform range of 0.7, as two independent ranges hold 90 % together.
  EXPECT_NEAR(prior.high - prior.low, 0.7 * std::sqrt(0.9), 0.7 * 0.02);
}

TEST(Prior, AFactorIsOneStandardDeviationOfTheLogarithm) {
  const ParameterPrior<base::Dimension::kNone> prior{.median = 0.3, .factor = 2};
  const auto normal = prior.Normal();
  ASSERT_TRUE(normal.has_value());
  EXPECT_TRUE(normal->of_logarithm);
  EXPECT_DOUBLE_EQ(normal->mean, std::log(0.3));
  EXPECT_DOUBLE_EQ(normal->sd, std::log(2.0));
}

TEST(NuisanceTexts, HalfOfThePriorsWidthIsDetermined) {
  ResultParameter p{.name = "e",
                    .searched_low = 0,
                    .searched_high = 1,
                    .credible_low = 0.3,
                    .credible_high = 0.3 + 0.44};
  p.nuisance.emplace();
  EXPECT_THAT(NuisanceText(p, "e"), HasSubstr("e: determined"));
  p.credible_high = 0.3 + 0.46;  // a flat prior's 90 % are 0.9
  EXPECT_THAT(NuisanceText(p, "e"), HasSubstr("e: not determined"));
}

}  // namespace priors_test
}  // namespace talus::campaign
