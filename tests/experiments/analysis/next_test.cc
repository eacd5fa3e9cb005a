#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/heap_pair.h"
#include "experiments/analysis/next/judge_test.h"
#include "experiments/analysis/next/known.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/test_design.h"
#include "experiments/analysis/report/data/report_data.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "tests/experiments/next_fixture.h"

namespace talus::analysis {
namespace next_test {

using campaign::JointView;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class NextTest : public NextFixture {};

TEST_F(NextTest, RanksWhatTrialsAlreadyTellAndAsksForTheOthers) {
  const JointView view = Run();
  const NextTable table = Rank(view, UsualTests(view), false);
  // A test as many as the heap took, more of the same as many as there are at the finest; none for
  // what is measured of heaps that are simulated.
  const int finest = static_cast<int>(
      std::ranges::count(view.observations, 1.0, &optimizer::Observation::scale_factor));
  ASSERT_GT(finest, 3);
  ASSERT_EQ(view.observations.size(), 24u);
  EXPECT_EQ(Find(table, "more runs of heap").num_simulations, 0);
  EXPECT_EQ(Find(table, "more simulations of heap").num_simulations, finest);
  for (const char* name : {"wide plate, 5 cm/s", "wide plate, 20 cm/s", "rough plate",
                           "tapped density", "column collapse", "tilting box", "shear cell",
                           "orifice flow", "funnel heap", "drum, 30 rpm"}) {
    EXPECT_EQ(Find(table, name).num_simulations, 24) << name;
  }
  ASSERT_EQ(table.candidates.size(), 13u);  // the finest grains are the true ones already
  const NextCandidate& mass = Find(table, "mass on the plate of heap");
  const NextCandidate& runs = Find(table, "more runs of heap");
  EXPECT_GT(mass.learning->bits, runs.learning->bits);
  EXPECT_GT(runs.learning->bits, 0);
  // A mass that falls with μ_t narrows its range.
  EXPECT_LT(mass.learning->width[0], table.width[0]);
  EXPECT_EQ(mass.num_simulations, 0);
  EXPECT_FALSE(Find(table, "wide plate, 5 cm/s").learning.has_value());
  EXPECT_GT(Find(table, "wide plate, 5 cm/s").core_time, 0);
  EXPECT_THAT(NextText(table), HasSubstr("--simulate"));
  EXPECT_FALSE(fs::exists(folder_ / "next")) << "looking must not write";
}

NextCandidate Leaving(const std::string& name, double volume, double bits) {
  return {.name = name,
          .learning = optimizer::ExpectedLearning{.bits = bits, .width = {}, .volume = volume}};
}

std::vector<std::string> NamesOf(const NextTable& table) {
  std::vector<std::string> names;
  for (const NextCandidate& c : table.candidates) names.push_back(c.name);
  return names;
}

// Bits count what two outputs say twice; the ranges that are left do not.
TEST(NextRanking, WhatLeavesTheSmallestRangesComesFirstAndWhatIsNotKnownLast) {
  NextTable table{.parameters = {},
                  .width = Eigen::Vector2d(0.4, 0.2),
                  .candidates = {{.name = "unknown"},
                                 Leaving("half", 0.5, 3),
                                 Leaving("nothing", 1, 0.1),
                                 Leaving("also half", 0.5, 4),
                                 Leaving("quarter", 0.25, 2)}};
  Rank(table);
  EXPECT_EQ(NamesOf(table),
            (std::vector<std::string>{"quarter", "also half", "half", "nothing", "unknown"}));
  EXPECT_DOUBLE_EQ(table.candidates[0].remaining, 0.25);
}

// A page of a campaign in whose folder the table stands, and the terminal's text of the table.
TEST_F(NextTest, PageAndTerminalHaveTheSameStepsInTheSameOrder) {
  const JointView view = Run();
  const NextTable table = Rank(view, {{.name = "again"}}, true);
  base::WriteFileAtomically(folder_ / "next" / "next.json", NextJson(table));
  Evidence evidence = GatherEvidence(folder_);
  AddModel(folder_, evidence);
  const std::vector<NextStep> steps = MakeReportData(std::move(evidence)).next_steps;
  const std::string text = NextText(table);
  std::size_t at = 0;
  int num_shown = 0;
  for (const NextStep& step : steps) {
    if (step.what.starts_with("Simulate more: talus")) continue;  // an alarm's, before all
    const std::size_t found = text.find(
        "  " + std::string(1, static_cast<char>(std::tolower(step.what[0]))) + step.what.substr(1));
    ASSERT_NE(found, std::string::npos) << step.what << "\n" << text;
    EXPECT_GT(found, at) << step.what << "\n" << text;
    at = found;
    ++num_shown;
  }
  EXPECT_GE(num_shown, 1);
  EXPECT_THAT(text, HasSubstr("expected to leave of their volume"));
}

// The drawn heaps say nothing of the plate, so its range stays; an instrument leaves a twentieth.
TEST_F(NextTest, FrictionOfAWallMayBeMeasuredByItself) {
  const fs::path spec = campaign::WriteFakeSpec(scratch_.path() / "in",
                                                R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)");
  std::string text = base::ReadFile(spec);
  text.insert(text.find("\"rolling_friction\""),
              "\"plate_sliding_friction\": {\"min\": 0.1, \"max\": 0.8}, ");
  base::WriteFileAtomically(spec, text);
  folder_ = scratch_.path() / "run";
  campaign::BeginCampaign(spec, folder_);
  campaign::RunFake(folder_, kSharp);
  const NextTable table = Rank(campaign::ReadJointView(folder_), {}, false);
  const NextCandidate& direct = table.candidates.front();
  EXPECT_EQ(direct.name, "plate_sliding_friction by itself");
  EXPECT_LT(direct.remaining, 0.2);
  EXPECT_FALSE(campaign::CanBeMeasuredDirectly("sliding_friction"));  // of two grains
  EXPECT_FALSE(campaign::CanBeMeasuredDirectly("plate_rolling_friction"));
}

TEST_F(NextTest, ADesignIsSimulatedOnceAndShowsTheSetsThatItTellsApart) {
  const JointView view = Run();
  const std::vector<TestCandidate> tests{{.name = "again: slowly!"}};
  const NextTable table = Rank(view, tests, true);
  const NextCandidate& again = Find(table, "again: slowly!");
  ASSERT_TRUE(again.learning.has_value());
  EXPECT_GT(again.learning->bits, 0);
  EXPECT_EQ(again.picture, folder_ / "next" / "again-slowly-.png");
  EXPECT_TRUE(fs::exists(again.picture));
  ASSERT_EQ(again.apart.size(), 2u);
  const auto time = fs::last_write_time(folder_ / "next/again-slowly-/trials/0001/profile.png");
  const NextTable later = Rank(view, tests, false);
  EXPECT_EQ(Find(later, again.name).learning->bits, again.learning->bits);
  EXPECT_EQ(fs::last_write_time(folder_ / "next/again-slowly-/trials/0001/profile.png"), time);
  EXPECT_THAT(NextJson(later), HasSubstr("\"told_apart\""));
  const fs::path design = folder_ / "next/again-slowly-/design.json";
  std::string damaged = base::ReadFile(design);
  damaged[damaged.rfind("0.") + 2] ^= 1;  // another point than was simulated
  base::WriteFileAtomically(design, damaged);
  EXPECT_FALSE(Find(Rank(view, tests, false), again.name).learning.has_value());
  Rank(view, tests, true);
  EXPECT_TRUE(Find(Rank(view, tests, false), again.name).learning.has_value());
}

// A lift that is ten times as slow takes several times as long to simulate.
TEST_F(NextTest, DesignsAreSimulatedWithinTheirBudgetTheCheapestFirst) {
  const JointView view = Run();
  TestCandidate slow{.name = "slow lift"};
  slow.device = view.spec.device;
  slow.device->lift_velocity /= 10;
  campaign::CoreTime core_time(view.spec);
  core_time.Of(view.trials);
  std::vector<std::string> said;
  NextOptions options{.tests = {slow, {.name = "again"}},
                      .simulate = true,
                      .core_time = 1.5 * kDesignSize * core_time.OfOne(0, 2),
                      .say = [&](const std::string& text) { said.push_back(text); }};
  options.parts = Parts(view);
  const NextTable table = RankNext(view, options);
  EXPECT_TRUE(Find(table, "again").learning.has_value());
  EXPECT_FALSE(Find(table, "slow lift").learning.has_value());
  EXPECT_THAT(Find(table, "slow lift").what, HasSubstr("judged by 16 coarse simulations"));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_THAT(said[0], HasSubstr("again: 16 simulations"));
  EXPECT_THAT(NextSummary(table), HasSubstr("again: expected to leave sliding_friction"));
  EXPECT_EQ(NextSummary(Rank(view, {}, false)), "");
  const std::string none = NextSummary(Rank(view, {slow, {.name = "quick"}}, false));
  EXPECT_THAT(none, HasSubstr("none could be simulated in that time: the cheapest, quick, takes"));
  EXPECT_THAT(none, HasSubstr("`talus next DIR --simulate --budget \"30 s\"`"));
  NextTable asked = Rank(view, {slow, {.name = "quick"}}, false);
  EXPECT_THAT(NextText(asked), HasSubstr("?: `talus next DIR --simulate` runs the few"));
  asked.has_simulated = true;
  asked.asked = " tests.json --for spread.json";
  EXPECT_THAT(NextText(asked),
              AllOf(HasSubstr("?: the core time was too short for it; the cheapest, "),
                    HasSubstr("`talus next DIR tests.json --for spread.json --simulate --budget")));
  // A share of the campaign's core time is one of all calls: each resume spent it anew.
  options.core_time = 1.001 * Find(table, "slow lift").core_time_to_judge;
  options.is_in_all = true;
  EXPECT_FALSE(Find(RankNext(view, options), "slow lift").learning.has_value());
  options.is_in_all = false;
  EXPECT_TRUE(Find(RankNext(view, options), "slow lift").learning.has_value());
}

// Two rectangles, of which the second is lower and wider: the difference has both colours, and two
// panels of grey stand before it.
TEST(HeapPair, ShowsWhereTwoHeapsDiffer) {
  const auto heap = [](int half_width, int height) {
    imaging::Profile profile{.image = {.width = 120, .height = 80, .pixels = {}},
                             .frame = campaign::FakeFrame()};
    profile.image.pixels.assign(120 * 80, 255);
    for (int x = 60 - half_width; x < 60 + half_width; ++x) {
      for (int y = 76 - height; y < 76; ++y) profile.image.at(x, y) = 0;
    }
    return profile;
  };
  imaging::ColorImage pair = DrawHeapPair(heap(20, 30), heap(30, 20));
  EXPECT_GT(pair.width, 3 * 320);
  int red = 0, blue = 0, coloured_before = 0;
  for (int y = 50; y < pair.height; ++y) {
    for (int x = 0; x < pair.width; ++x) {
      const auto [r, g, b] = pair.at(x, y);
      red += r == 255 && g == 0 && b == 0;
      blue += r == 0 && g == 0 && b == 255;
      if (3 * x < 2 * pair.width - 60) coloured_before += r != g || g != b;
    }
  }
  // 40 x 10 px only in the first, 2 x 10 x 20 px only in the second, each some pixels wide.
  EXPECT_GT(red, 300);
  EXPECT_EQ(red, blue);
  EXPECT_EQ(coloured_before, 0);
}

TEST_F(NextTest, ADesignOfAnotherDeviceIsNotTakenForThis) {
  const JointView view = Run();
  TestCandidate test{.name = "fast"};
  test.device = view.spec.device;
  test.device->lift_velocity = 0.1;
  Rank(view, {test}, true);
  test.device->lift_velocity = 0.2;
  EXPECT_FALSE(Find(Rank(view, {test}, false), "fast").learning.has_value());
}

// To 1 kg/m³ over 350 kg/m³ the drawn heaps' density tells μ_r to 0.003; the heap leaves 0.01.
TEST_F(NextTest, ATestOfNumbersOnlyIsJudgedByThem) {
  const JointView view = Run();
  const std::vector<TestCandidate> usual = UsualTests(view);
  const auto tapped = std::find_if(usual.begin(), usual.end(), [](const TestCandidate& test) {
    return test.name == "tapped density";
  });
  TestCandidate weighed = *tapped;
  weighed.numbers.Of<rigs::Observable::kTappedDensity>() = {.standard_error = 1};
  const NextTable table = Rank(view, {weighed}, true);
  const NextCandidate& judged = Find(table, "tapped density");
  ASSERT_TRUE(judged.learning.has_value()) << judged.what;
  EXPECT_GT(judged.learning->bits, 0.5);
  EXPECT_LT(judged.learning->width[1], 0.9 * table.width[1]);
  EXPECT_EQ(judged.num_made, 16);
  EXPECT_TRUE(judged.picture.empty());
  ASSERT_EQ(judged.numbers.size(), 1u);
  EXPECT_EQ(judged.numbers[0].metric, "tapped_density_kg_per_m3");
  EXPECT_GT(std::abs(judged.numbers[0].first - judged.numbers[0].second), 10);
  EXPECT_THAT(NextText(table), HasSubstr("16 of them made"));
}

TEST_F(NextTest, FinerGrainsAreWorthMoreWhereTheModelErrorLeavesMore) {
  folder_ = Begin(R"(, "coarse_graining": {"scale_factors": [2.4, 2]},
    "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)");
  campaign::RunFake(folder_, {});
  const JointView view = campaign::ReadJointView(folder_);
  const NextTable table = Rank(view, {}, false);
  const NextCandidate& finer = Find(table, "finer grains in heap");
  EXPECT_GT(finer.learning->bits, 0);
  EXPECT_THAT(finer.what, HasSubstr("scale factor 1.414"));
  const NextCandidate& more = Find(table, "more simulations of heap");
  // The step is √2 and core time goes with f⁻⁴.
  EXPECT_NEAR(finer.core_time / more.core_time, 4, 1e-9);
  // Heaps of grains that are √2 finer scatter by 2^(-3/2) of the variance, and so what no
  // simulation can match; of the runs' and the surrogate's error as many again leave the half.
  const auto strategy = campaign::AnsweringStrategy(view);
  const Ground ground{.view = view,
                      .temper = strategy->Model().temper(),
                      .draws = strategy->Sample().Draws(1000, view.spec.seed)};
  const Known heap = KnownExperiments(ground, strategy->Model()).front();
  const auto bits = [&](const Eigen::ArrayXd& less) {
    const Eigen::ArrayXd now = heap.at.measured + heap.at.model + heap.surrogate;
    const Eigen::ArrayXd own = (1 / (now - less) - 1 / now).inverse();
    return ground.Learn({.mean = heap.at.mean, .variance = own}).bits;
  };
  EXPECT_NEAR(finer.learning->bits, bits((1 - std::pow(2, -1.5)) * heap.at.model), 1e-9);
  EXPECT_NEAR(more.learning->bits, bits(heap.surrogate / 2), 1e-9);
  EXPECT_NEAR(Find(table, "more runs of heap").learning->bits, bits(heap.at.measured / 2), 1e-9);
}

// The errors a and b of two tests were learnt: a third is taken to have √((a² + b²)/2).
TEST_F(NextTest, ATestThatWasNotMadeErrsAsThoseThatWere) {
  const fs::path spec = campaign::WriteFakeSpec(scratch_.path() / "in", R"(,
    "coarse_graining": {"scale_factor": 2},
    "budget": {"simulations": 16}, "confirm": {"candidates": 0}, "workers": 1)");
  nlohmann::json text = nlohmann::json::parse(base::ReadFile(spec));
  text["experiments"] = {
      text["experiment"],
      {{"name", "balance"}, {"mass_fallen", {{"value", "50 mg"}, {"sd", "1 mg"}}}}};
  text["experiments"][0]["name"] = "heap";
  text.erase("experiment");
  base::WriteFileAtomically(spec, text.dump());
  folder_ = scratch_.path() / "run";
  campaign::BeginCampaign(spec, folder_);
  campaign::RunFake(folder_, kSharp);
  JointView view = campaign::ReadJointView(folder_);
  view.spec.posterior.learn_model_error = true;  // by the answer alone: it slows a search down
  const TestCandidate test{.name = "again"};
  const NextTable table = Rank(view, {test}, true);
  const auto strategy = campaign::AnsweringStrategy(view);
  const auto& models = strategy->Model().models();
  ASSERT_EQ(models.size(), 2u);
  const double a = models[0].model_error().value, b = models[1].model_error().value;
  ASSERT_GT(std::abs(a - b), 0.05);  // else the root mean square is the mean
  Ground ground{.view = view,
                .draws = strategy->Sample().Draws(1000, view.spec.seed),
                .model_error = std::sqrt((a * a + b * b) / 2)};
  ground.surrogate_share = SurrogateShare(KnownExperiments(ground, strategy->Model()));
  const std::optional<TestDesign> design = StoredDesign(view, test, *Parts(view).engine);
  NextCandidate judged{.name = test.name};
  JudgeTest(ground, {.test = test, .design = design.value(), .unknown = {}}, judged);
  const Eigen::ArrayXd expected = judged.predicted.variance;
  const Eigen::ArrayXd variance = Find(table, test.name).predicted.variance;
  EXPECT_LT((variance / expected - 1).abs().maxCoeff(), 1e-9);
}

TEST_F(NextTest, TooFewTrialsForAPosteriorAreSaid) {
  const fs::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"simulations": 3}, "confirm": {"candidates": 0}, "workers": 1)");
  campaign::RunFake(folder, {});
  EXPECT_THROW(Rank(campaign::ReadJointView(folder), {}, false), base::Error);
}

}  // namespace next_test
}  // namespace talus::analysis
