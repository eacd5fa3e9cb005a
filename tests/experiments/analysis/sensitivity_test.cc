#include "experiments/analysis/sensitivity/sensitivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::analysis {
namespace sensitivity_test {

using campaign::FakeEngine;
using campaign::JointView;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Drawn heaps whose slope follows μ_r + 0.2 (0.9 - e): at e = 0.6 the same heap wants a μ_r that is
// lower by 0.06, and no other μ_t.
class SensitivityTest : public campaign::CampaignFixture {
 protected:
  static constexpr campaign::FakeEngineOptions kBouncing{.restitution_as_rolling = 0.2};

  static constexpr const char* kBudget = R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 36}, "confirm": {"candidates": 0}, "workers": 1)";

  JointView Run() {
    folder_ = Finished(kBudget, kBouncing);
    return campaign::ReadJointView(folder_);
  }
  static SensitivityTable Find(const JointView& view,
                               std::vector<std::pair<std::string, std::string>> moves,
                               const campaign::FakeEngineOptions& engine = kBouncing) {
    return FindWith(view, {.moves = std::move(moves)}, engine);
  }
  static SensitivityTable FindWith(const JointView& view, SensitivityOptions options,
                                   const campaign::FakeEngineOptions& engine = kBouncing) {
    options.parts = {.runner = campaign::MakeDrawnRunner(view.spec, view.folder.root),
                     .engine = std::make_unique<FakeEngine>(engine)};
    return FindSensitivity(view, options);
  }
  static std::string ErrorOf(const JointView& view, const std::string& name,
                             const std::string& value) {
    return ErrorIn([&] { Find(view, {{name, value}}); });
  }
  static const FixedMove& Move(const SensitivityTable& table, const std::string& name) {
    for (const FixedMove& move : table.moves) {
      if (move.name == name) return move;
    }
    throw base::Error("no move " + name);
  }
  static const AnswerShift& Of(const FixedMove& move, const std::string& parameter) {
    for (const AnswerShift& shift : move.answer) {
      if (shift.parameter == parameter) return shift;
    }
    throw base::Error("no parameter " + parameter);
  }
  fs::path folder_;
};

TEST_F(SensitivityTest, ShiftOfTheAnswerIsWhatTheMovedThingDoes) {
  const JointView view = Run();
  const SensitivityTable table = Find(view, {{"restitution", "0.6"}});
  const FixedMove& move = Move(table, "restitution");
  EXPECT_EQ(move.from, "0.9");
  const AnswerShift& rolling = Of(move, "rolling_friction");
  // The slopes scatter by 0.01, so that four and eight of them leave 0.006, and the draws 0.01.
  EXPECT_NEAR(rolling.to - rolling.from, -0.06, 0.02);
  EXPECT_GT(rolling.standard_error, 0.001);
  EXPECT_LT(rolling.standard_error, 0.015);
  EXPECT_TRUE(rolling.Exceeds());
  // The range moves with the answer. The surrogate has fewer trials there, so that it may be wider.
  const SensitivityParameter& now = table.parameters[1];
  EXPECT_LT(rolling.low, rolling.to);
  EXPECT_GT(rolling.high, rolling.to);
  EXPECT_GT(rolling.high - rolling.low, 0.5 * (now.high - now.low));
  EXPECT_LT(rolling.high - rolling.low, 4 * (now.high - now.low));
  const AnswerShift& sliding = Of(move, "sliding_friction");
  EXPECT_NEAR(sliding.to, sliding.from, 0.03);
  EXPECT_FALSE(sliding.Exceeds());
  EXPECT_FALSE(move.FitsNoSet());
  ASSERT_EQ(move.outputs.size(), 1u);
  EXPECT_GT(move.outputs[0].shift, 2 * move.outputs[0].noise);
  ASSERT_EQ(SensitivityAlarms(table).size(), 1u);
  EXPECT_THAT(SensitivityText(table),
              HasSubstr("warning: restitution 0.6 in place of 0.9 would move rolling_friction"));
}

// It was kept as a failure of what was moved, also when there was room again.
TEST_F(SensitivityTest, ADiskThatIsFullIsNoFailureOfASimulation) {
  const JointView view = Run();
  EXPECT_THAT(
      [&] {
        Find(view, {{"restitution", "0.6"}}, {.disk_full = true});
      },
      ::testing::ThrowsMessage<base::Unwritten>(
          ::testing::AllOf(HasSubstr("No space left on device"),
                           HasSubstr("; mend this, and the same command goes on"))));
  const SensitivityTable table = Find(view, {{"restitution", "0.6"}});
  EXPECT_EQ(Move(table, "restitution").num_failed, 0);
  EXPECT_TRUE(Of(Move(table, "restitution"), "rolling_friction").Exceeds());
}

// A move of which nothing is known was said to fit perfectly, and one number that no simulation
// has to be shifted by 0, once the file was read again.
TEST(Sensitivity, WhatIsNotKnownIsNullInTheFileAndWhenItIsRead) {
  const ScratchFolder scratch;
  const OutputShift undefined{.experiment = "heap", .output = "angle", .num_modes = 1};
  WriteSensitivity(
      {.moves = {{.name = "density", .why_not = "the engine's templates do not take it"},
                 {.name = "filling", .outputs = {undefined}}}},
      scratch.path());
  const auto json = nlohmann::json::parse(base::ReadFile(SensitivityFile(scratch.path())));
  EXPECT_TRUE(json["moves"][0]["implausibility_sd"].is_null());
  EXPECT_TRUE(json["moves"][1]["outputs"][0]["shift_in_noise_sd"].is_null());
  const SensitivityTable table = LoadSensitivity(scratch.path()).value();
  EXPECT_TRUE(std::isnan(table.moves[0].implausibility));
  EXPECT_FALSE(table.moves[0].FitsNoSet());
  EXPECT_THAT(SensitivityText(table), HasSubstr("angle not known, as simulations have no value"));
}

// The answer jumped within a wide region, and a move that no output had felt was blamed for it.
TEST(Sensitivity, WhatOutputsDoNotFeelMovesNoAnswer) {
  FixedMove move{
      .name = "youngs_modulus",
      .outputs =
          {{.experiment = "heap", .output = "image", .shift = 0.67, .noise = 1.2, .num_modes = 8},
           {.experiment = "heap", .output = "angle", .shift = -0.16, .noise = 1.3, .num_modes = 1}},
      .answer = {{.parameter = "sliding_friction", .half_ranges = 1.3, .half_ranges_error = 0.2}}};
  EXPECT_FALSE(move.Exceeds());
  EXPECT_FALSE(move.IsTold());
  move.outputs[1].shift = -2.6;  // as chance makes it of one number in twenty
  EXPECT_FALSE(move.Exceeds());
  move.outputs[1].shift = -4.6;
  EXPECT_TRUE(move.Exceeds());
  EXPECT_TRUE(move.IsTold());
}

// μ_r (1 + 2 (0.9 - e)) = 0.2: the shift is 0.12 at μ_r = 0.2, which would lead to 0.08, and 0.075
// at the answer, 0.125. The campaign has few trials there, and sets of another μ_t would fit as
// far as it knows: what is simulated there says that they do not.
TEST_F(SensitivityTest, AShiftThatDependsOnTheSetIsTheOneAtTheAnswer) {
  constexpr campaign::FakeEngineOptions kStretched{.restitution_times_rolling = 2};
  folder_ = Finished(kBudget, kStretched);
  const SensitivityTable table =
      Find(campaign::ReadJointView(folder_), {{"restitution", "0.6"}}, kStretched);
  const FixedMove& move = Move(table, "restitution");
  EXPECT_GE(move.num_followed, 1);
  const AnswerShift& rolling = Of(move, "rolling_friction");
  // As above, the answer's own error included.
  EXPECT_NEAR(rolling.to, rolling.from / 1.6, 0.02);
  const AnswerShift& sliding = Of(move, "sliding_friction");
  EXPECT_NEAR(sliding.to, sliding.from, 0.03);
  EXPECT_LT(sliding.low, sliding.from);
  EXPECT_GT(sliding.high, sliding.from);
  EXPECT_THAT(SensitivityText(table), HasSubstr("; anew at the answer foretold, "));
  EXPECT_GT(table.num_simulations, 3 * move.replicates);
}

// The answer is foretold without a campaign; one that is told of the other value finds it.
TEST_F(SensitivityTest, CampaignWithTheOtherValueFindsWhatIsForetold) {
  const JointView view = Run();
  const SensitivityTable table = Find(view, {{"restitution", "0.6"}});
  const AnswerShift& foretold = Of(Move(table, "restitution"), "rolling_friction");
  const fs::path spec = campaign::WriteFakeSpec(scratch_.path() / "other_in", kBudget);
  std::string text = base::ReadFile(spec);
  const std::string searched = "\"parameters\": {";
  text.insert(text.find(searched) + searched.size(), "\"restitution\": {\"fixed\": 0.6}, ");
  std::ofstream(spec) << text;
  const fs::path other = scratch_.path() / "other";
  campaign::BeginCampaign(spec, other);
  campaign::RunFake(other, kBouncing);
  // 32 simulations leave its answer uncertain; what is foretold is one of those that it leaves.
  const campaign::ResultParameter& found = Result(other).parameters[1];
  EXPECT_GT(foretold.to, found.credible_low);
  EXPECT_LT(foretold.to, found.credible_high);
  EXPECT_GT(foretold.from, found.credible_high) << "and the answer as it stands is none of them";
}

// What changes nothing is told apart from what matters, by more replicates where it must be.
TEST_F(SensitivityTest, UsualMovesAreJudgedAndOnlyRestitutionMatters) {
  const JointView view = Run();
  const SensitivityTable table = Find(view, {});
  EXPECT_EQ(table.moves.front().name, "restitution");
  EXPECT_TRUE(table.moves.front().Exceeds());
  for (const char* name :
       {"rolling_damping", "youngs_modulus", "plate_pair_sliding_friction", "sizes", "mass",
        "tube_pair_sliding_friction", "lift_velocity", "filling", "full_mobilisation_damping"}) {
    EXPECT_FALSE(Move(table, name).Exceeds()) << name;
    EXPECT_GE(Move(table, name).replicates, kFirstReplicates) << Move(table, name).why_not;
  }
  EXPECT_EQ(table.scale_factor, 2);
  EXPECT_FALSE(fs::exists(folder_ / "sensitivity.json")) << "the caller writes it";
}

TEST_F(SensitivityTest, WhatIsSearchedIsNotMoved) {
  const JointView view = Run();
  JointView plate = view;
  plate.space.parameters.push_back({.name = "plate_sliding_friction", .low = 0.1, .high = 0.6});
  const auto moves = UsualMoves(plate, campaign::TypicalCase(view.spec, 0, 2));
  for (const analysis::Move& move : moves) EXPECT_NE(move.name, "plate_pair_sliding_friction");
  const rigs::Case typical = campaign::TypicalCase(view.spec, 0, 2);
  JointView weighed = view;
  weighed.space.parameters.push_back({.name = "mass", .low = 0.4e-3, .high = 0.6e-3});
  const auto is_mass = [](const analysis::Move& move) { return move.name == "mass"; };
  EXPECT_TRUE(std::ranges::any_of(UsualMoves(view, typical), is_mass));
  EXPECT_FALSE(std::ranges::any_of(UsualMoves(weighed, typical), is_mass));
  // A second experiment's own handling is moved, too, each to what it is not.
  rigs::Case tapped = typical;
  tapped.rig.kind = rigs::RigKind::kFunnelHeap;
  tapped.filling.kind = rigs::FillingKind::kPour;
  const auto of_both = UsualMoves(view, std::vector<rigs::Case>{tapped, typical});
  EXPECT_EQ(std::ranges::count(of_both, "lift_velocity", &analysis::Move::name), 1);
  EXPECT_EQ(std::ranges::count(of_both, "filling", &analysis::Move::name), 1);
  rigs::Case moved = typical;
  std::ranges::find(of_both, "filling", &analysis::Move::name)->apply(moved);
  EXPECT_NE(moved.filling.kind, typical.filling.kind);
  EXPECT_EQ(MoveTo(view, typical, "mass", "0.6 g").from, "0.0005 kg");
  // A test of another mass is moved by the same ratio: it was given the first test's.
  rigs::Case heavier = typical;
  heavier.powder.mass = 1e-3;
  MoveTo(view, typical, "mass", "0.6 g").apply(heavier);
  EXPECT_NEAR(heavier.powder.mass, 1.2e-3, 1e-15);
  EXPECT_EQ(MoveTo(view, typical, "particle_size", "1.1").from, "1");
  // One that is fixed at 1.2 has made the case's grains larger by that already.
  JointView larger = view;
  larger.space.parameters.push_back({.name = "particle_size", .fixed = 1.2});
  rigs::Case grains = typical;
  campaign::SetParameter(grains, "particle_size", 1.2);
  const analysis::Move size = MoveTo(larger, grains, "particle_size", "1.5");
  EXPECT_EQ(size.from, "1.2");
  size.apply(grains);
  EXPECT_NEAR(*grains.powder.sizes.diameter, 1.5 * *typical.powder.sizes.diameter, 1e-15);
  EXPECT_THAT(ErrorOf(view, "rolling_friction", "0.2"), HasSubstr("is searched"));
  EXPECT_THAT(ErrorOf(view, "restitution", "0.9"), HasSubstr("in the campaign already"));
  EXPECT_THAT(ErrorOf(view, "restitution", "1.5"), HasSubstr("must be in (0, 1]"));
  EXPECT_THAT(ErrorOf(view, "restitutoin", "0.5"), HasSubstr("did you mean \"restitution\"?"));
  EXPECT_THAT(ErrorOf(view, "wobble", "0.5"), HasSubstr("is no parameter; there are "));
  EXPECT_THAT(ErrorOf(view, "fill", "0.3"), HasSubstr("is moved as the mass"));
  EXPECT_THAT(ErrorOf(view, "hamaker_constant", "1e-19 J"), HasSubstr("has no effect but with"));
}

TEST_F(SensitivityTest, AnAnswerIsFollowedAsFarAsItsCoreTimeGoes) {
  const FixedMove move =
      Move(FindWith(Run(), {.moves = {{"restitution", "0.6"}}, .core_time = 0}), "restitution");
  EXPECT_EQ(move.num_followed, 0);
  EXPECT_EQ(move.replicates, kFirstReplicates);
  EXPECT_TRUE(move.moves_still);
  EXPECT_THAT(move.why_not_followed, HasSubstr("no more processor time"));
}

// μ_r + 1.2 is beyond all that is searched.
TEST_F(SensitivityTest, AValueThatNoSetFitsWithIsSaid) {
  constexpr campaign::FakeEngineOptions kFar{.restitution_as_rolling = 4};
  folder_ = Finished(kBudget, kFar);
  const SensitivityTable table =
      Find(campaign::ReadJointView(folder_), {{"restitution", "0.6"}}, kFar);
  EXPECT_TRUE(Move(table, "restitution").FitsNoSet());
  EXPECT_THAT(SensitivityText(table), HasSubstr("no set fits with it: the answer is "));
  EXPECT_THAT(SensitivityText(table), HasSubstr("half of its stated range, though no set fits"));
}

TEST_F(SensitivityTest, SimulationsAreRunOnce) {
  const JointView view = Run();
  const SensitivityTable first = Find(view, {{"restitution", "0.6"}});
  // An engine without a program: whatever it had to run would be missing.
  const SensitivityTable again =
      Find(view, {{"restitution", "0.6"}}, {.no_command = true, .restitution_as_rolling = 0.2});
  EXPECT_EQ(again.num_simulations, first.num_simulations);
  EXPECT_EQ(Of(Move(again, "restitution"), "rolling_friction").to,
            Of(Move(first, "restitution"), "rolling_friction").to);
  EXPECT_EQ(Move(again, "restitution").num_failed, 0);
}

}  // namespace sensitivity_test
}  // namespace talus::analysis
