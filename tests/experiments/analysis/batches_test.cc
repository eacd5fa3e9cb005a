// Batches of a powder, with drawn heaps in place of simulations.
#include "experiments/analysis/batches/batches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <tuple>

#include "base/error.h"
#include "base/files/file.h"
#include "base/random.h"
#include "experiments/analysis/batches/batch_pictures.h"
#include "experiments/analysis/batches/batch_warnings.h"
#include "experiments/analysis/batches/batches_text.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace batches_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

std::vector<imaging::GrayImage> Heaps(double sliding, int count, std::uint64_t seed) {
  std::vector<imaging::GrayImage> heaps;
  for (int i = 0; i < count; ++i) {
    heaps.push_back(campaign::DrawHeap(sliding, 0.2, seed + static_cast<std::uint64_t>(i)));
  }
  return heaps;
}

// Four runs and four: 70 ways to deal them out, of which only this one and its mirror are as far
// apart.
TEST(Permute, RunsOfTwoPowdersAreToldApartByEveryArrangement) {
  const PermutationTest test = Permute(Heaps(0.3, 4, 1), Heaps(0.6, 4, 100), 1);
  EXPECT_EQ(test.num_arrangements, 70);
  EXPECT_DOUBLE_EQ(test.probability, 2.0 / 70);
  EXPECT_GT(test.distance_px, 0);
}

// Forty pairs of batches of one powder: a test at 5 % claims two of them on average, more than six
// with a probability of 1 %.
TEST(Permute, RunsOfOnePowderDifferByChanceOnly) {
  int claimed = 0;
  for (std::uint64_t pair = 0; pair < 40; ++pair) {
    claimed +=
        Permute(Heaps(0.4, 4, 1000 * pair), Heaps(0.4, 4, 1000 * pair + 500), 1).probability < 0.05;
  }
  EXPECT_LE(claimed, 6);
}

TEST(Permute, ManyRunsAreDealtOutByChance) {
  EXPECT_EQ(Permute(Heaps(0.4, 10, 1), Heaps(0.4, 10, 50), 1).num_arrangements, 5000);
}

// By hand: χ² of 4 degrees of freedom is beyond x with probability (1 + x/2) e^(−x/2).
TEST(ChanceTogether, IsFishersAndThatOfOneTestItsOwn) {
  EXPECT_EQ(ChanceTogether({}), 1);
  EXPECT_NEAR(ChanceTogether({0.3}), 0.3, 1e-15);
  EXPECT_NEAR(ChanceTogether({0.3, 0.05}), 0.015 * (1 - std::log(0.015)), 1e-15);
  EXPECT_EQ(ChanceTogether({1, 1, 1}), 1);
}

// 2000 pairs of equal batches with three tests: 5 ± 1.5 % (three standard errors) are below 5 %;
// each test by itself would claim 14 %.
TEST(ChanceTogether, ClaimsNoMoreTheMoreTestsThereAre) {
  int claimed = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    base::Random random(1, base::Stream("equal batches"), i);
    claimed += ChanceTogether({random.Uniform(), random.Uniform(), random.Uniform()}) < 0.05;
  }
  EXPECT_NEAR(claimed, 100, 30);
}

BatchComparison WithPictures(double heap, double wide_plate) {
  BatchComparison c{.batches = {"first", "second"}};
  c.together = {{.batch = "second"}};
  c.pictures = {{.batch = "second", .experiment = "heap", .probability = heap},
                {.batch = "second", .experiment = "wide plate", .probability = wide_plate}};
  return c;
}

TEST(VerdictOf, PicturesOfAllTestsAreJudgedTogether) {
  EXPECT_FALSE(VerdictOf(WithPictures(0.3, 0.048), 1).is_found);
  EXPECT_EQ(VerdictOf(WithPictures(0.3, 0.008), 1).text, "differs: the photographs of wide plate");
  EXPECT_EQ(VerdictOf(WithPictures(0.06, 0.06), 1).text,
            "differs: what was measured together, nothing of it by itself");
}

// Three standard errors: 0.27 % where they are known exactly, 4.0 % by Student's t of 4 degrees of
// freedom where three runs in each batch tell them (tables).
TEST(ChanceOf, FewRunsKnowTheirErrorBadly) {
  constexpr double kExact = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(ChanceOf(-0.3, {0.1, kExact}), 0.0027, 1e-5);
  EXPECT_NEAR(ChanceOf(0.3, {0.1, 4}), 0.0399, 1e-4);
  EXPECT_EQ(ChanceOf(0, {0.1, 4}), 1);
  EXPECT_GT(ChanceOf(1e3, {0.1, kExact}), 0);  // whose logarithm is taken
}

// Equal errors of three runs each know what six less two do; one that is much the larger decides.
TEST(ErrorOfDifference, HasTheDegreesOfFreedomOfBoth) {
  const KnownError equal = ErrorOfDifference({0.3, 2}, {0.3, 2});
  EXPECT_NEAR(equal.value, 0.3 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(equal.degrees, 4, 1e-9);
  EXPECT_NEAR(ErrorOfDifference({0.001, 9}, {0.3, 1}).degrees, 1, 1e-3);
  EXPECT_NEAR(ErrorOfDifference({0.3, std::numeric_limits<double>::infinity()}, {0.3, 1}).degrees,
              4, 1e-9);
}

TEST(VerdictOf, ANumberIsJudgedWithThePhotographsOfItsHeaps) {
  BatchComparison c = WithPictures(0.5, 0.03);
  c.numbers = {{.batch = "second", .experiment = "wide plate", .name = "mass_fallen_kg"}};
  c.numbers[0].probability = 0.004;  // twice that of the test, with the heap's 0.5: 2.6 %
  const BatchVerdict apart = VerdictOf(c, 1);
  EXPECT_EQ(apart.text, "differs: the photographs of wide plate, mass fallen of wide plate");
  EXPECT_NEAR(apart.measured_by_chance, 0.004 * (1 - std::log(0.004)), 1e-12);
  c.numbers[0].probability =
      0.9;  // the photographs' 0.03 counts twice, and is 13.5 % with the heap's
  EXPECT_NEAR(VerdictOf(c, 1).measured_by_chance, 0.03 * (1 - std::log(0.03)), 1e-12);
  EXPECT_FALSE(VerdictOf(c, 1).is_found);
}

// Draws along a valley of sd 1 and across it of sd 0.1. One that is moved by 0.25 across lies
// inside ± 1.64 sd of either parameter, and at the level 1 - exp(-2.5² / 2) = 0.956 of both; three
// standard errors of 4000 draws are 0.01, and the sample's covariance adds as much.
TEST(LevelOfNone, AShiftAcrossAValleyIsSeenInBothParametersTogether) {
  base::Random random(1, base::Stream("valley"), 0);
  Eigen::MatrixXd draws(4000, 2);
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const double along = random.Normal();
    const double across = 0.1 * random.Normal();
    draws.row(i) << (along + across) / std::sqrt(2), (across - along) / std::sqrt(2);
  }
  EXPECT_LT(LevelOfNone(draws), 0.01);
  const double shift = 0.25 / std::sqrt(2);
  EXPECT_NEAR(LevelOfNone(draws.array() + shift), 1 - std::exp(-0.5 * 2.5 * 2.5), 0.02);
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class BatchesTest : public campaign::CampaignFixture {
 protected:
  // A campaign that has met a heap of these, from which so much has fallen.
  fs::path Run(const std::string& name, double sliding, const std::string& fallen = "23 mg",
               const std::string& more = "", const std::string& scale = "linear") const {
    static campaign::FinishedCampaigns<std::tuple<double, std::string, std::string, std::string>>
        campaigns;
    campaigns.Copy({sliding, fallen, more, scale}, scratch_.path() / name, [&](const fs::path& in) {
      Finish(in, {.sliding = sliding, .fallen = fallen, .more = more, .scale = scale});
    });
    return scratch_.path() / name;
  }

 private:
  struct Made {
    double sliding = 0;
    std::string fallen;
    std::string more;
    std::string scale;  // of the sliding friction; "nuisance": it is one
  };
  static void Finish(const fs::path& scratch, const Made& made) {
    const fs::path spec = campaign::WriteFakeSpec(scratch / "in",
                                                  R"(, "budget": {"simulations": 24},
        "confirm": {"candidates": 0}, "workers": 1)" + made.more);
    imaging::WritePng(spec.parent_path() / "map.png", campaign::DrawHeap(made.sliding, 0.2, 12345));
    std::string text = base::ReadFile(spec);
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace(R"("experiment": {)",
            R"("experiments": [{"name": "heap", "mass_fallen": {"sd": "1 mg", "value": ")" +
                made.fallen + R"("}, )");
    replace(R"("max": 0.8})", made.scale == "nuisance"
                                  ? R"("max": 0.8, "nuisance": true})"
                                  : R"("max": 0.8, "scale": ")" + made.scale + "\"}");
    replace(R"("10 mm"}},)", R"("10 mm"}}],)");
    std::ofstream(spec) << text;
    campaign::BeginCampaign(spec, scratch / "run");
    EXPECT_EQ(campaign::RunFake(scratch / "run", {}), campaign::CampaignEnd::kFinished);
  }
};

TEST_F(BatchesTest, AShiftedBatchIsFoundAndAnEqualOneIsNot) {
  const fs::path first = Run("first", 0.4);
  const fs::path equal = Run("equal", 0.4);
  const fs::path shifted = Run("shifted", 0.6);
  const BatchComparison c = CompareBatches({first, equal, shifted}, {{"sliding_friction", "0.1"}});
  ASSERT_EQ(c.parameters.size(), 2u);
  const BatchParameter& sliding = c.parameters[0];
  EXPECT_FALSE(sliding.differences[0].is_found);
  EXPECT_LT(sliding.differences[0].probability, 0.2);
  EXPECT_TRUE(sliding.differences[1].is_found);
  EXPECT_NEAR(sliding.differences[1].range.median, 0.2, 0.05);
  EXPECT_GT(sliding.differences[1].probability, 0.9);
  EXPECT_FALSE(c.together[0].is_found);
  EXPECT_TRUE(c.together[1].is_found);
  EXPECT_FALSE(c.verdicts[0].is_found);
  EXPECT_TRUE(c.verdicts[1].is_found);
  EXPECT_FALSE(c.parameters[1].differences[1].is_found);            // rolling is the same
  EXPECT_DOUBLE_EQ(c.parameters[1].differences[0].matters, 0.045);  // a tenth of 0.05 to 0.5
  EXPECT_THAT(c.pictures[0].absent, HasSubstr("fewer than two photographed runs"));
  const std::string text = BatchesText(c);
  EXPECT_THAT(text, HasSubstr("equal: no difference found"));
  EXPECT_THAT(text, HasSubstr("shifted: differs: sliding_friction by 0."));
  const std::string csv = BatchesCsv(c);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * 2);
  EXPECT_THAT(BatchesSvg(c, sliding), HasSubstr("sliding_friction"));
  const std::string page = BatchesPage(c);
  EXPECT_THAT(page, HasSubstr("differs: sliding_friction by 0."));
  EXPECT_EQ(Count(page, "<svg"), 2);  // a chart a parameter
}

// Each more that nobody asks for would widen the joint region, and hide what is asked for.
TEST_F(BatchesTest, ANuisanceIsShownAndDecidesNothing) {
  const fs::path first = Run("first", 0.4, "23 mg", "", "nuisance");
  const fs::path shifted = Run("shifted", 0.6, "23 mg", "", "nuisance");
  const BatchComparison c = CompareBatches({first, shifted}, {});
  EXPECT_TRUE(c.parameters[0].is_nuisance);
  EXPECT_TRUE(c.parameters[0].differences[0].is_found);
  EXPECT_FALSE(c.parameters[1].is_nuisance);
  EXPECT_EQ(NumAsked(c), 1);
  // Of one parameter all together is that one.
  EXPECT_EQ(c.together[0].is_found, c.parameters[1].differences[0].is_found);
  EXPECT_THAT(c.verdicts[0].text, Not(HasSubstr("sliding_friction")));
  EXPECT_THAT(BatchesText(c), HasSubstr("sliding_friction (not asked for)  0."));
  EXPECT_THAT(BatchesText(c), Not(HasSubstr("all parameters together")));
  EXPECT_THAT(BatchesPage(c), HasSubstr("sliding_friction (not asked for)"));
}

// On a linear scale a tenth of the range mattered at its low end as at its high one.
TEST_F(BatchesTest, OfALogarithmicParameterTheFactorCounts) {
  const fs::path first = Run("first", 0.4, "23 mg", "", "log");
  const fs::path shifted = Run("shifted", 0.6, "23 mg", "", "log");
  const BatchComparison c = CompareBatches({first, shifted}, {{"sliding_friction", "1.2"}});
  const BatchDifference& sliding = c.parameters[0].differences[0];
  EXPECT_NEAR(sliding.range.median, 1.5, 0.15);
  EXPECT_TRUE(sliding.is_found);
  EXPECT_GT(sliding.probability, 0.9);
  EXPECT_THAT(c.verdicts[0].text, HasSubstr("sliding_friction by a factor of 1."));
  EXPECT_THAT(BatchesText(c), HasSubstr("larger than × 1.2 with"));
  // A tenth of the range from 0.1 to 0.8 is the tenth root of 8.
  EXPECT_NEAR(CompareBatches({first, shifted}, {}).parameters[0].differences[0].matters,
              std::pow(8, 0.1), 1e-12);
  EXPECT_THROW(CompareBatches({first, shifted}, {{"sliding_friction", "0.1"}}), base::ConfigError);
}

// The first batch from 10 to 40 µJ/m², the other twice that.
TEST(BatchesText, DifferencesOfEnergiesAreFactorsAndThoseOfLinearOnesHaveTheirUnit) {
  BatchComparison c{.batches = {"a", "b"}};
  c.parameters = {{.name = "surface_energy", .unit = "J/m2", .scale = "log"}};
  BatchParameter& energy = c.parameters[0];
  energy.batches = {{.median = 2e-5, .low = 1e-5, .high = 4e-5},
                    {.median = 4e-5, .low = 2e-5, .high = 8e-5}};
  energy.differences = {
      {.range = {.median = 2, .low = 1.2, .high = 3}, .matters = 1.5, .is_found = true}};
  c.together = {{.batch = "b", .is_found = true}};
  EXPECT_EQ(VerdictOf(c, 1).text, "differs: surface_energy by a factor of 2");
  c.verdicts = {VerdictOf(c, 1)};
  EXPECT_THAT(BatchesText(c),
              HasSubstr("difference × 2 (median; 90 % in 1.2 … 3), either way larger than × 1.5"));
  EXPECT_THAT(BatchesSvg(c, energy), HasSubstr("10⁻⁵"));  // a tick of a logarithmic axis
  energy.scale = "linear";
  EXPECT_EQ(VerdictOf(c, 1).text, "differs: surface_energy by 2 J/m2");
}

// 28 ± 1 and 23 ± 1 mg: -5 ± 1.41, which chance alone makes once in 2500.
TEST_F(BatchesTest, WhatWasWeighedIsComparedToo) {
  const BatchComparison c = CompareBatches({Run("first", 0.4, "28 mg"), Run("other", 0.4)}, {});
  ASSERT_EQ(c.numbers.size(), 1u);
  EXPECT_NEAR(c.numbers[0].difference, -5e-6, 1e-12);
  EXPECT_NEAR(c.numbers[0].standard_error, std::sqrt(2) * 1e-6, 1e-12);
  EXPECT_NEAR(c.numbers[0].probability, 4e-4, 1e-5);
  EXPECT_THAT(c.verdicts[0].text, HasSubstr("mass fallen of heap"));
  EXPECT_THAT(BatchesText(c), HasSubstr("mass fallen differs by -5 ± 1.4 mg"));
  EXPECT_THAT(BatchesPage(c), HasSubstr("Numbers measured"));
}

// A difference of the parameters may come of another device, or of a campaign that warns of itself.
TEST_F(BatchesTest, WhatSpeaksAgainstAComparisonIsSaid) {
  const fs::path first = Run("first", 0.4);
  const BatchComparison alike = CompareBatches({first, Run("equal", 0.4)}, {});
  EXPECT_THAT(BatchesText(alike), testing::Not(HasSubstr("other conditions")));
  const fs::path slow = Run("slow", 0.4, "23 mg", R"(, "device": {"lift_velocity": "2 cm/s"})");
  const BatchComparison c = CompareBatches({first, slow}, {});
  EXPECT_THAT(BatchesText(c), HasSubstr("slow: other conditions than in"));
  EXPECT_THAT(BatchesText(c), HasSubstr("lift_velocity is 0.01 there and 0.02 here"));
  EXPECT_THAT(BatchesPage(c), HasSubstr("lift_velocity"));
  std::size_t num_alarms = 0;
  for (const fs::path& folder : {first, slow}) {
    for (const campaign::Alarm& alarm : Result(folder).warnings) {
      EXPECT_THAT(BatchesText(c),
                  HasSubstr(campaign::WithFolder(campaign::AlarmText(alarm), folder)));
      ++num_alarms;
    }
  }
  EXPECT_GT(num_alarms, 0u);
  EXPECT_THAT(BatchesText(c), testing::Not(HasSubstr(" DIR")));  // commands name the folder
}

// Batches of two engines were compared as if their parameters meant the same.
TEST_F(BatchesTest, OtherEnginesAreSaidFirst) {
  const fs::path folder = Run("first", 0.4);
  const campaign::JointView first = campaign::ReadJointView(folder);
  campaign::JointView batch = first;
  EXPECT_EQ(OtherEngine(first, batch), "");
  batch.spec.engine.kind = campaign::EngineKind::kCommand;
  batch.spec.engine.command.command = {"lmp", "-in", "in.heap"};
  EXPECT_THAT(OtherEngine(first, batch),
              testing::AllOf(HasSubstr("\"lmp -in in.heap\""), HasSubstr("talus itself")));
  campaign::JointView other = batch;
  other.spec.engine.command.templates_hash = "1";
  EXPECT_THAT(OtherEngine(batch, other), HasSubstr("other templates"));
  const std::string text = BatchesText(
      {.batches = {"a", "b"}, .verdicts = {{.text = "equal"}}, .other_engines = {"engines"}});
  EXPECT_LT(text.find("warning: engines"), text.find("b: equal"));
  const std::string page = BatchesPage({.batches = {"a", "b"},
                                        .together = {{.batch = "b"}},
                                        .verdicts = {{.text = "equal"}},
                                        .warnings = {"`talus resume b` goes on"}});
  EXPECT_THAT(page, HasSubstr("<code>talus resume b</code> goes on"));
}

// The first of one campaign was set against the first of the other, whatever they were.
TEST_F(BatchesTest, ConditionsAreThoseOfExperimentsOfOneName) {
  const campaign::JointView first = campaign::ReadJointView(Run("first", 0.4));
  campaign::JointView slow = campaign::ReadJointView(
      Run("slow", 0.4, "23 mg", R"(, "device": {"lift_velocity": "2 cm/s"})"));
  EXPECT_EQ(OtherConditions(first, slow).size(), 1u);
  slow.record.experiments.front().name = "slow heap";
  const std::vector<std::string> texts = OtherConditions(first, slow);
  ASSERT_EQ(texts.size(), 1u);  // the lift is no other condition of a test that both have
  EXPECT_THAT(texts.front(), HasSubstr("only there, and \"slow heap\" only here"));
}

// The first batch's fixed values were given to the other, too.
TEST_F(BatchesTest, FixedParametersThatDifferAreConditions) {
  const campaign::JointView first = campaign::ReadJointView(Run("first", 0.4));
  const auto with_fixed = [&](std::optional<double> restitution) {
    campaign::JointView view = first;
    if (restitution) {
      view.spec.parameters->restitution.emplace();
      view.spec.parameters->restitution->fixed = restitution;
    }
    view.space = campaign::SpaceOf(view.spec);
    return view;
  };
  const double own = first.spec.powder.material.restitution;
  EXPECT_TRUE(OtherConditions(first, with_fixed(own)).empty());
  EXPECT_TRUE(OtherConditions(with_fixed(0.5), with_fixed(0.5)).empty());
  EXPECT_THAT(OtherConditions(with_fixed(own), with_fixed(0.5)).front(), HasSubstr("restitution"));
  EXPECT_THAT(OtherConditions(first, with_fixed(0.5)).front(), HasSubstr("restitution"));
  // One that only one of the two searches is no condition.
  campaign::JointView searched = first;
  searched.spec.parameters->restitution.emplace();
  searched.spec.parameters->restitution->min = 0.3;
  searched.spec.parameters->restitution->max = 0.7;
  searched.space = campaign::SpaceOf(searched.spec);
  EXPECT_TRUE(OtherConditions(first, searched).empty());
  EXPECT_TRUE(OtherConditions(searched, first).empty());
}

// "Holds for scale factor 1" and "for 2" were compared without a word.
TEST_F(BatchesTest, AnswersForOtherGrainSizesAreConditions) {
  const campaign::JointView first = campaign::ReadJointView(Run("first", 0.4));
  campaign::JointView finer = first;
  finer.spec.coarse_graining.target = first.spec.coarse_graining.Target() / 2;
  EXPECT_THAT(OtherConditions(first, finer).front(), HasSubstr("that it answers for is"));
}

TEST_F(BatchesTest, OneCampaignIsRefusedAndAnUnfinishedOneIsSaid) {
  const fs::path first = Run("first", 0.4);
  try {
    CompareBatches({first, first / "."}, {});
    FAIL();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("is named twice"));
  }
  journal::Journal::Open(journal::JournalPath(first))
      .SetProgress({.state = journal::CampaignState::kInterrupted});
  EXPECT_THAT(AlarmsOf(campaign::ReadJointView(first)).front(), HasSubstr("is not finished"));
}

TEST_F(BatchesTest, OtherParametersAreRefused) {
  const fs::path first = Run("first", 0.4);
  EXPECT_THROW(CompareBatches({first, first}, {{"slidin_friction", "0.1"}}), base::ConfigError);
  EXPECT_THROW(CompareBatches({first, first}, {{"sliding_friction", "-1"}}), base::ConfigError);
  try {
    CompareBatches({first, first}, {{"sliding_friction", "wide"}});
    FAIL();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--matters sliding_friction: \"wide\""));
  }
}

// Two numbers of the same heaps: the smaller chance of them is that of two looks.
TEST(BatchVerdict, SeveralNumbersOfATestAreSeveralLooks) {
  BatchComparison c;
  c.batches = {"a", "b"};
  c.together.resize(1);
  for (const char* name : {"mass_fallen_kg", "height_m"}) {
    BatchNumber number;
    number.batch = "b";
    number.experiment = "heap";
    number.name = name;
    number.probability = 0.03;
    c.numbers.push_back(number);
  }
  const BatchVerdict verdict = VerdictOf(c, 1);
  EXPECT_NEAR(verdict.measured_by_chance, 0.06, 1e-12);
  EXPECT_FALSE(verdict.is_found);
}

}  // namespace batches_test
}  // namespace talus::analysis
