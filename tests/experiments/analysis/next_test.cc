#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

#include "base/error.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/heap_pair.h"
#include "experiments/analysis/next/goal.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/rank_next.h"
#include "experiments/analysis/next/test_design.h"
#include "experiments/analysis/next/usual_tests.h"
#include "experiments/analysis/predict/predict.h"
#include "experiments/analysis/report/data/report_data.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace next_test {

using campaign::FakeEngine;
using campaign::JointView;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Two scale factors; what falls off the plate tells μ_t, and nobody has weighed it.
class NextTest : public campaign::CampaignFixture {
 protected:
  // The drawn heap alone leaves μ_t and μ_r to 0.01: numbers that scatter by less tell more.
  static constexpr campaign::FakeEngineOptions kSharp{.mass_scatter = 1e-7, .density_scatter = 0.5};

  JointView Run() {
    folder_ = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)");
    campaign::RunFake(folder_, kSharp);
    return campaign::ReadJointView(folder_);
  }
  static NextTable Rank(const JointView& view, std::vector<TestCandidate> tests, bool simulate) {
    NextOptions options{.tests = std::move(tests), .simulate = simulate};
    options.parts = {.runner = campaign::MakeRunner(view.spec, view.folder.root),
                     .engine = std::make_unique<FakeEngine>(kSharp)};
    return RankNext(view, options);
  }
  static campaign::CampaignParts Parts(const JointView& view) {
    return {.runner = campaign::MakeRunner(view.spec, view.folder.root),
            .engine = std::make_unique<FakeEngine>(kSharp)};
  }
  fs::path Taps() const {
    const fs::path file = scratch_.path() / "taps.json";
    std::ofstream(file) << R"({"powder": {"material": {"density": 2500},
      "sizes": {"kind": "mono", "diameter": "0.4 mm"},
      "mass": "0.5 g"}, "rig": {"kind": "tapped_density", "diameter": "10 mm"},
      "filling": {"kind": "pour"}})";
    return file;
  }
  static const NextCandidate& Find(const NextTable& table, const std::string& name) {
    for (const NextCandidate& c : table.candidates) {
      if (c.name == name) return c;
    }
    throw base::Error("no candidate " + name);
  }
  fs::path folder_;
};

TEST_F(NextTest, RanksWhatTrialsAlreadyTellAndAsksForTheOthers) {
  const JointView view = Run();
  const NextTable table = Rank(view, UsualTests(view), false);
  for (const char* name : {"more runs of heap", "more simulations of heap",
                           "mass on the plate of heap", "wide plate, 5 cm/s", "wide plate, 20 cm/s",
                           "rough plate", "tapped density", "column collapse", "tilting box",
                           "shear cell", "orifice flow", "funnel heap", "drum, 30 rpm"}) {
    EXPECT_GE(Find(table, name).num_simulations, 0);
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

NextCandidate Leaving(const std::string& name, const Eigen::Vector2d& width, double bits) {
  return {.name = name, .learning = optimizer::ExpectedLearning{.bits = bits, .width = width}};
}

std::vector<std::string> NamesOf(const NextTable& table) {
  std::vector<std::string> names;
  for (const NextCandidate& c : table.candidates) names.push_back(c.name);
  return names;
}

// The entry that `talus next` leaves for a test is one that `talus add-experiment` takes.
TEST_F(NextTest, EntriesOfTestsHaveNamesThatAnExperimentMayHave) {
  const JointView view = Run();
  for (const TestCandidate& test : UsualTests(view)) {
    EXPECT_THAT(ExperimentText(view, test), testing::Not(HasSubstr("/"))) << test.name;
  }
}

// Bits count what two outputs say twice; the ranges that are left do not.
// A test is simulated with the first experiment's own mass; added without it, it would be another.
TEST_F(NextTest, EntriesOfTestsHaveTheMassThatTheyWereSimulatedWith) {
  JointView view = Run();
  const TestCandidate tapped = UsualTests(view)[3];
  ASSERT_EQ(tapped.name, "tapped density");
  EXPECT_THAT(ExperimentText(view, tapped), HasSubstr("\"mass\": 0.0005"));
  auto experiments = campaign::ExperimentsOf(view.spec);
  experiments.front().mass = 0.25e-3;  // half of the powder's
  view.spec.experiment.reset();
  view.spec.experiments = experiments;
  EXPECT_THAT(ExperimentText(view, tapped), HasSubstr("\"mass\": 0.00025"));
  EXPECT_LT(UsualTests(view)[3].rig->tapped_density.diameter, tapped.rig->tapped_density.diameter);
}

TEST(NextRanking, WhatLeavesTheSmallestRangesComesFirstAndWhatIsNotKnownLast) {
  NextTable table{.parameters = {},
                  .width = Eigen::Vector2d(0.4, 0.2),
                  .candidates = {{.name = "unknown"},
                                 Leaving("half", {0.4, 0.1}, 3),
                                 Leaving("nothing", {0.44, 0.2}, 0.1),
                                 Leaving("also half", {0.2, 0.2}, 4),
                                 Leaving("quarter", {0.2, 0.1}, 2)}};
  Rank(table);
  EXPECT_EQ(NamesOf(table),
            (std::vector<std::string>{"quarter", "also half", "half", "nothing", "unknown"}));
  EXPECT_DOUBLE_EQ(table.candidates[0].remaining, 0.25);
  EXPECT_EQ(table.candidates[3].remaining, 1);  // wider by chance is no loss
  table.nuisances = {1};                        // nobody asks how well the second is known
  Rank(table);
  EXPECT_EQ(table.candidates[0].name, "also half");
  EXPECT_DOUBLE_EQ(table.candidates[0].remaining, 0.5);
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
  options.parts = {.runner = campaign::MakeRunner(view.spec, view.folder.root),
                   .engine = std::make_unique<FakeEngine>(kSharp)};
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

// The drawn density is 1550 − 350 μ_r kg/m³: what tells μ_t alone, however well, does not help it.
TEST_F(NextTest, ForAGoalWhatNarrowsItComesFirst) {
  const JointView view = Run();
  const GoalRequest request{.file = Taps(), .observable = "tapped_density"};
  NextOptions options{.tests = UsualTests(view), .simulate = false};
  std::erase_if(options.tests, [](const auto& test) { return test.name != "tapped density"; });
  options.tests[0].numbers.Of<rigs::Observable::kTappedDensity>() = {.standard_error = 0.5};
  options.simulate = true;
  options.parts = Parts(view);
  options.goal = SimulateGoal(view, request, Parts(view));
  const NextTable table = RankNext(view, options);
  ASSERT_TRUE(table.goal.has_value());
  EXPECT_EQ(table.goal->number, "tapped_density_kg_per_m3");
  EXPECT_EQ(table.goal->num_draws, 12);
  // Scatter of a mean of 3 runs is 0.3; half of a 90 % range of μ_r alone is 0.32 of its joint one
  // if that holds 95 % of a normal.
  const double rolling = view.space.parameters[1].high - view.space.parameters[1].low;
  EXPECT_NEAR(table.goal->half_width, 350 * rolling * table.width[1] * 0.42,
              0.2 * table.goal->half_width);
  EXPECT_LT(table.goal->left_out_error, 0.2 * table.goal->half_width);  // draws at the ends count
  const NextCandidate& mass = Find(table, "mass on the plate of heap");
  const NextCandidate& density = Find(table, "tapped density");
  EXPECT_EQ(table.candidates.front().name, "tapped density");
  // It tells of the sliding friction, as far as 24 trials know.
  EXPECT_GT(mass.learning->bits, 0.2);
  EXPECT_GT(mass.learning->goal_half_width, 0.8 * table.goal->half_width);
  EXPECT_LT(density.learning->goal_half_width, 0.7 * table.goal->half_width);
  EXPECT_THAT(NextText(table), HasSubstr("of the goal, sliding_friction"));
  EXPECT_THAT(NextJson(table), HasSubstr("\"goal_half_width_90\""));
}

TEST_F(NextTest, RunsOfAnEarlierPredictionServeAGoalAndAreNotMadeAgain) {
  const JointView view = Run();
  Predict(view, {.file = Taps(), .num_draws = 8, .num_seeds = 2, .scale_factors = {2}},
          Parts(view));
  const fs::path trials = folder_ / "predict/taps/trials";
  const auto time = fs::last_write_time(trials / "0001_1/profile.png");
  const Goal goal = SimulateGoal(view, {.file = Taps()}, Parts(view));
  EXPECT_EQ(goal.num_draws, 8);
  EXPECT_EQ(goal.num_runs, 16);
  EXPECT_EQ(goal.scale_factor, 2);
  EXPECT_EQ(fs::last_write_time(trials / "0001_1/profile.png"), time);
}

TEST_F(NextTest, AGoalThatTheTestDoesNotMeasureNamesThoseThereAreAndCostsNothing) {
  const JointView view = Run();
  try {
    SimulateGoal(view, {.file = Taps(), .observable = "runout"}, Parts(view));
    FAIL();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no observable \"runout\"; it has poured_density"));
  }
  const fs::path column = scratch_.path() / "column.json";
  std::ofstream(column) << R"({"powder": {"material": {"density": 2500},
    "sizes": {"kind": "mono", "diameter": "0.4 mm"},
    "mass": "0.5 g"}, "rig": {"kind": "column_collapse", "length": "5 mm", "width": "8 mm"}})";
  try {
    SimulateGoal(view, {.file = column}, Parts(view));
    FAIL();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has several observables"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "predict"));
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
}

TEST_F(NextTest, WhatCannotBeSimulatedIsSaidAndNotTried) {
  const JointView view = Run();
  TestCandidate narrow{.name = "narrow"};
  narrow.device = view.spec.device;
  narrow.device->tube_inner_diameter = 2.2e-3;  // grains of the coarse factor are 0.8 mm
  const TestCandidate taken{.name = campaign::ExperimentsOf(view.spec).front().name};
  const NextTable table = Rank(view, {narrow, taken}, true);
  EXPECT_THAT(Find(table, "narrow").what, HasSubstr("must be above three (scaled) grain"));
  const bool said = std::ranges::any_of(table.candidates, [](const NextCandidate& candidate) {
    return candidate.what.find("is that of an experiment of the campaign") != std::string::npos;
  });
  EXPECT_TRUE(said);
  EXPECT_FALSE(fs::exists(folder_ / "next"));
}

// Each was simulated and ranked, and refused when it had been made.
TEST_F(NextTest, WhatAddExperimentWouldRefuseIsNotRanked) {
  const JointView view = Run();
  TestCandidate fast{.name = "fast"};
  fast.device = view.spec.device;
  fast.device->lift_velocity = 50;  // mm/s, it was meant
  TestCandidate unfilmed{.name = "unfilmed"};
  unfilmed.rig.emplace().kind = rigs::RigKind::kDrum;
  unfilmed.numbers.Of<rigs::Observable::kCohesiveIndex>() = {.standard_error = 0.1};
  TestCandidate odd{.name = "odd"};
  odd.numbers.Of<rigs::Observable::kTappedDensity>() = {.standard_error = 4};
  const NextTable table = Rank(view, {fast, unfilmed, odd}, true);
  EXPECT_THAT(Find(table, "fast").what,
              HasSubstr("cannot be simulated: fast: device.lift_velocity"));
  EXPECT_THAT(Find(table, "unfilmed").what, HasSubstr("cohesive_index: needs a camera"));
  EXPECT_THAT(Find(table, "odd").what, HasSubstr("tapped_density: is not measured by the rig"));
  EXPECT_FALSE(fs::exists(folder_ / "next"));
}

TEST_F(NextTest, CandidatesComeFromAFile) {
  const fs::path file = scratch_.path() / "tests.json";
  std::ofstream(file) << R"({"candidates": [{"name": "fast", "device": {"lift_velocity": "20 cm/s"},
                                             "runs": 5},
    {"name": "tapped", "rig": {"kind": "tapped_density"}, "filling": {"kind": "pour"},
     "tapped_density": {"sd": "4 kg/m^3"}}]})";
  const std::vector<TestCandidate> tests = LoadTests(file);
  ASSERT_EQ(tests.size(), 2u);
  EXPECT_EQ(tests[1].rig.value().kind, rigs::RigKind::kTappedDensity);
  EXPECT_EQ(tests[1].numbers.Of<rigs::Observable::kTappedDensity>().value().standard_error, 4);
  EXPECT_EQ(tests[0].runs, 5);
  EXPECT_EQ(tests[0].device.value().lift_velocity, 0.2);
  std::ofstream(file) << R"({"candidates": [{"runs": 0}]})";
  EXPECT_THROW(LoadTests(file), base::ConfigError);
  // Their simulations stand in folders of these names: one would be lost.
  for (const char* other : {"fast lift", "fast-lift"}) {
    std::ofstream(file) << R"({"candidates": [{"name": "fast lift"}, {"name": ")" << other
                        << "\"}]}";
    EXPECT_THROW(LoadTests(file), base::ConfigError) << other;
  }
}

// It would be ranked, simulated and made, and then refused.
TEST_F(NextTest, ATestThatCouldNotBeAddedSaysWhy) {
  const JointView view = Run();
  TestCandidate test{.name = "drum"};
  test.rig.emplace().kind = rigs::RigKind::kDrum;
  test.rig->drum.speed = 40;
  EXPECT_THAT(WhyNot(view, test), HasSubstr("rig.speed: is 40, rad/s is so fast"));
  const TestCandidate same{.name = view.record.experiments.front().name};
  EXPECT_THAT(WhyNot(view, same), HasSubstr("is that of an experiment of the campaign"));
  for (const TestCandidate& usual : UsualTests(view)) EXPECT_EQ(WhyNot(view, usual), "");
}

TEST_F(NextTest, TooFewTrialsForAPosteriorAreSaid) {
  const fs::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"simulations": 3}, "confirm": {"candidates": 0}, "workers": 1)");
  campaign::RunFake(folder, {});
  EXPECT_THROW(Rank(campaign::ReadJointView(folder), {}, false), base::Error);
}

}  // namespace next_test
}  // namespace talus::analysis
