// Which tests `talus next` ranks: the usual ones and those of a file, as `talus add-experiment`
// takes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "experiments/analysis/next/advise.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/usual_tests.h"
#include "tests/experiments/next_fixture.h"

namespace talus::analysis {
namespace next_candidates_test {

using campaign::JointView;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class NextCandidates : public NextFixture {};

// The entry that `talus next` leaves for a test is one that `talus add-experiment` takes.
TEST_F(NextCandidates, EntriesOfTestsHaveNamesThatAnExperimentMayHave) {
  const JointView view = Run();
  ASSERT_FALSE(UsualTests(view).empty());
  for (const TestCandidate& test : UsualTests(view)) {
    EXPECT_THAT(ExperimentText(view, test), testing::Not(HasSubstr("/"))) << test.name;
  }
}

// A test is simulated with the first experiment's own mass; added without it, it would be another.
TEST_F(NextCandidates, EntriesOfTestsHaveTheMassThatTheyWereSimulatedWith) {
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

// A drum has no tube: that of another experiment, or of the campaign, is the one at hand.
TEST_F(NextCandidates, PlatesAreMadeForTheTubeThatIsAtHand) {
  JointView view = Run();
  std::vector<campaign::ExperimentSpec> experiments(2, campaign::ExperimentsOf(view.spec).front());
  experiments[0].name = "drum";
  experiments[0].rig.emplace().kind = rigs::RigKind::kDrum;
  experiments[1].device->tube_inner_diameter = 14e-3;
  view.spec.experiment.reset();
  view.spec.experiments = experiments;
  const auto wide = [&] {
    const auto tests = UsualTests(view);
    const auto found = std::ranges::find_if(
        tests, [](const TestCandidate& test) { return test.name == "wide plate, 5 cm/s"; });
    return found == tests.end() ? 0.0 : found->device->plate_diameter;
  };
  EXPECT_DOUBLE_EQ(wide(), 42e-3);
  view.spec.experiments->pop_back();
  view.spec.device.tube_inner_diameter = 8e-3;
  EXPECT_DOUBLE_EQ(wide(), 24e-3);
}

TEST_F(NextCandidates, WhatCannotBeSimulatedIsSaidAndNotTried) {
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
TEST_F(NextCandidates, WhatAddExperimentWouldRefuseIsNotRanked) {
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
  EXPECT_THAT(Find(table, "fast").what, HasSubstr("cannot be simulated: device.lift_velocity"));
  EXPECT_THAT(Find(table, "unfilmed").what, HasSubstr("cohesive_index: needs a camera"));
  EXPECT_THAT(Find(table, "odd").what, HasSubstr("tapped_density: is not measured by the rig"));
  EXPECT_THAT(NextJson(table), testing::Not(HasSubstr("\"needs_simulations\": true")));
  EXPECT_FALSE(fs::exists(folder_ / "next"));
}

TEST_F(NextCandidates, TwoAtOnceDoNotSimulateTheSameDesigns) {
  const JointView view = Run();
  fs::create_directories(folder_ / "next");
  const campaign::CampaignLock other(folder_ / "next");
  try {
    Advise(folder_, {.simulate = true});
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another process"));
  }
  Advise(folder_, {});  // looking is for all
}

TEST_F(NextCandidates, CandidatesComeFromAFile) {
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
  // An error of a radian: a good test told nothing.
  std::ofstream(file) << R"({"candidates": [{"name": "drum", "rig": {"kind": "drum"},
                                             "angle": {"sd": 1}}]})";
  EXPECT_THROW(LoadTests(file), base::ConfigError);
  // Their simulations stand in folders of these names: one would be lost.
  for (const char* other : {"fast lift", "fast-lift"}) {
    std::ofstream(file) << R"({"candidates": [{"name": "fast lift"}, {"name": ")" << other
                        << "\"}]}";
    EXPECT_THROW(LoadTests(file), base::ConfigError) << other;
  }
}

// It would be ranked, simulated and made, and then refused.
TEST_F(NextCandidates, ATestThatCouldNotBeAddedSaysWhy) {
  const JointView view = Run();
  TestCandidate test{.name = "drum"};
  test.rig.emplace().kind = rigs::RigKind::kDrum;
  test.rig->drum.speed = 40;
  EXPECT_THAT(WhyNot(view, test), HasSubstr("rig.speed: is 40, in rad/s, so fast"));
  const TestCandidate same{.name = view.record.experiments.front().name};
  EXPECT_THAT(WhyNot(view, same), HasSubstr("is that of an experiment of the campaign"));
  for (const TestCandidate& usual : UsualTests(view)) EXPECT_EQ(WhyNot(view, usual), "");
}

// One deck was run as if it were other tests, and all of them were ranked.
TEST_F(NextCandidates, ADeckSimulatesOnlyTheTestsThatItTakes) {
  JointView view = Run();
  const fs::path deck = scratch_.path() / "deck";
  fs::create_directories(deck);
  std::ofstream(deck / "in.heap") << "{{ sliding_friction }} {{ rolling_friction }}";
  view.spec.engine.kind = campaign::EngineKind::kCommand;
  view.spec.engine.command.templates = deck;
  view.spec.engine.command.command = {"lmp", "-in", "in.heap"};
  TestCandidate wide{.name = "wide"};
  wide.device = view.spec.device;
  wide.device->plate_diameter *= 1.5;
  TestCandidate drum{.name = "drum"};
  drum.rig.emplace().kind = rigs::RigKind::kDrum;
  EXPECT_EQ(WhyNot(view, TestCandidate{.name = "the same"}), "");
  EXPECT_THAT(WhyNot(view, wide), HasSubstr("templates have no {{ plate_diameter }}"));
  EXPECT_THAT(WhyNot(view, wide), HasSubstr("they would simulate both alike in that"));
  EXPECT_THAT(WhyNot(view, drum), HasSubstr("{{ rig_kind }}"));
  EXPECT_THAT(Find(Rank(view, {wide}, true), "wide").what, HasSubstr("cannot be simulated: "));
  std::ofstream(deck / "in.heap", std::ios::app) << "{{ plate_radius }}";
  EXPECT_EQ(WhyNot(view, wide), "");
}

// It was asked for simulations that it had already.
TEST(NextText, ATestThatTellsNothingIsNotAskedToBeSimulated) {
  NextCandidate mute{
      .name = "mute", .what = "tells nothing", .num_simulations = 20, .num_made = 16};
  NextTable table;
  table.candidates = {mute};
  EXPECT_THAT(NextText(table), HasSubstr("     -   mute: tells nothing"));
  EXPECT_THAT(NextText(table), testing::Not(HasSubstr("?:")));
  table.candidates[0].num_made = 4;
  EXPECT_THAT(NextText(table), HasSubstr("     ?   mute: tells nothing"));
}

}  // namespace next_candidates_test
}  // namespace talus::analysis
