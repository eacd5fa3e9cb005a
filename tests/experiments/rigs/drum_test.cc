// A drum that turns: its angle, its fill, its covers, and what has no angle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/sample.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/phased/surface.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/rigs/rig_run.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace drum_test {

using ::testing::HasSubstr;

TEST(Drum, TheDynamicAngleGrowsWithFriction) {
  std::vector<double> angles;
  for (const double friction : {0.1, 0.6}) {
    Case c = CaseOf(RigKind::kDrum, friction, friction / 3, 0.7e-3);
    c.rig.drum = {.diameter = 0.024, .width = 0.006, .speed = 4, .start_turns = 0.2, .turns = 0.25};
    c.materials.walls = WallMaterial{.sliding_friction = 0.9};
    const auto rig = Ran(c);
    angles.push_back(Value(c, *rig, "angle_deg"));
  }
  EXPECT_GT(angles[0], 5);
  EXPECT_GT(angles[1], angles[0] + 5);
  EXPECT_LT(angles[1], 60);
}

// Grains that weigh a hundredth of what they cling with go round with the shell: the highest grains
// are no surface, and the slope through them no angle.
TEST(Drum, APowderThatClingsToTheShellHasNoAngle) {
  Case c = CaseOf(RigKind::kDrum, 0.7, 0.3, 0.3e-3);
  c.rig.drum = {.diameter = 0.012, .width = 0.005, .speed = 8, .start_turns = 0.5, .turns = 0.25};
  const double weight = kDensity * std::numbers::pi / 6 * 1e-9 * c.gravity;
  c.powder.material.surface_energy = 100 * weight / (2 * std::numbers::pi * 0.25e-3);
  c.models.adhesion = engine::Adhesion::kDmt;
  const auto rig = Ran(c);
  const auto result = nlohmann::json::parse(rig->ResultText({}, {}));
  EXPECT_THAT(std::string(result["undefined"]["angle_deg"]), HasSubstr("hangs from the shell"));
}

constexpr const char* kLump = "the powder turns with the drum as one lump";

// As one lump it has the slope that it came with, whichever way that points by now.
TEST(Drum, APowderThatTurnsAsOneLumpHasNoAngle) {
  for (const double turns : {0.25, 1.0}) {
    Case c = CaseOf(RigKind::kDrum, 0.7, 0.3, 0.3e-3);
    c.rig.drum = {
        .diameter = 0.012, .width = 0.005, .speed = 8, .start_turns = 0.5, .turns = turns};
    c.powder.material.surface_energy = 1;
    c.models.adhesion = engine::Adhesion::kDmt;
    const auto rig = Ran(c);
    const auto result = nlohmann::json::parse(rig->ResultText({}, {}));
    EXPECT_TRUE(result["undefined"].contains("angle_deg")) << turns;
    EXPECT_FALSE(result["observables"].contains("angle_deg")) << turns;
    if (turns == 1) {
      EXPECT_EQ(result["undefined"]["angle_deg"], kLump);
    }
  }
}

// Between two avalanches a powder turns with its drum for a while, and a few grains have no
// surface.
TEST(Drum, APowderThatRisesBeforeItsAvalancheIsNoLump) {
  Case c = CaseOf(RigKind::kDrum, 0.6, 0.2, 0.7e-3);
  c.rig.drum = {.diameter = 0.024, .width = 0.006, .speed = 4, .start_turns = 0.02, .turns = 0.04};
  EXPECT_LT(Value(c, *Ran(c), "angle_deg"), 45);
  c.rig.drum.start_turns = 0;  // its first rise is seen, and what flows after it
  c.rig.drum.turns = 0.2;
  EXPECT_LT(Value(c, *Ran(c), "angle_deg"), 45);
  c.powder.mass = 3e-6;
  const auto few = Ran(c);
  const auto result = nlohmann::json::parse(few->ResultText({}, {}));
  EXPECT_THAT(std::string(result["undefined"]["angle_deg"]), HasSubstr("too few grains"));
}

// A few grains that the shell carries through the measured strips made looks of -38 degrees.
TEST(Drum, AFewGrainsThatClingDoNotTiltTheSurface) {
  Case c = CaseOf(RigKind::kDrum, 0.5, 0.1, 0.7e-3);
  c.rig.drum = {.diameter = 0.024, .width = 0.006, .speed = 4, .start_turns = 0.3, .turns = 0.25};
  c.models.adhesion = engine::Adhesion::kJkr;
  c.powder.material.surface_energy = 0.01;
  const auto rig = Ran(c);
  EXPECT_GT(Value(c, *rig, "angle_deg"), 35);
  EXPECT_LT(Value(c, *rig, "angle_sd_deg"), 15);
}

TEST(Drum, AFillStandsForItsMass) {
  Case c = CaseOf(RigKind::kDrum, 0.5, 0.1, 0);
  c.rig.drum = {.diameter = 0.084, .width = 0.02, .fill = 0.5};
  const double disc = std::numbers::pi / 4 * 0.084 * 0.084;
  c.SetMassByFill();
  EXPECT_NEAR(c.powder.mass, 0.5 * kSeenSolidFraction * disc * 0.02 * kDensity, 1e-12);
  EXPECT_FALSE(c.rig.drum.fill);
}

TEST(Drum, CoversHaveAMaterialOfTheirOwn) {
  Case c = Filmed();
  EXPECT_EQ(WallMaterialsOf(c), (std::vector{kWalls, kWalls, kWalls}));
  c.materials.floor = WallMaterial{.sliding_friction = 0.2};
  EXPECT_EQ(WallMaterialsOf(c), (std::vector{kWalls, kFloor, kFloor}));
}

TEST(Drum, AtASpeedThatPinsThePowderToTheWallItIsRefused) {
  Case c = CaseOf(RigKind::kDrum, 0.5, 0.1, 0.7e-3);
  c.rig.drum = {.diameter = 0.024, .width = 0.006, .speed = 30};  // ω²R/g = 1.1
  base::Problems problems;
  ValidateCase(c, problems);
  ASSERT_EQ(problems.list().size(), 1);
  EXPECT_EQ(problems.list().front().path, "rig.speed");
  EXPECT_THAT(problems.list().front().message, HasSubstr("turns with the drum"));
}

// S-shaped surfaces are flatter between their ends: 45.8 for 46.8 degrees here. Seen to 0.02.
TEST(Drum, TheAngleIsThatOfTheMiddleHalfOfTheSurface) {
  Case c = CaseOf(RigKind::kDrum, 0.6, 0.2, 0.7e-3);
  c.rig.drum = {.diameter = 0.024, .width = 0.006, .speed = 4, .start_turns = 0.2, .turns = 0.25};
  c.materials.walls = WallMaterial{.sliding_friction = 0.9};
  const auto rig = MakeRig(c);
  const auto along = [](const engine::Particle& p) { return p.position.x; };
  std::vector<double> angles;
  while (rig->Advance()) {
    if (rig->phase_name() != "turning") continue;
    const std::vector<engine::Particle> grains = rig->simulation().Particles();
    const double low = MassQuantile(grains, 0.02, along), high = MassQuantile(grains, 0.98, along);
    const double quarter = (high - low) / 4;
    const auto surface =
        SurfaceOf(grains, {.from = low + quarter, .to = high - quarter, .width = 1e-3});
    angles.push_back(SlopeAngle(-SlopeOf(surface).value()));
  }
  EXPECT_NEAR(Value(c, *rig, "angle_deg"), base::SampleOf(angles).mean, 0.5);
}

}  // namespace drum_test
}  // namespace talus::rigs
