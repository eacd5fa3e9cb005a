#include "experiments/rigs/case/case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/files/file.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/case_warnings.h"
#include "experiments/rigs/case/device_text.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/time_step.h"
#include "experiments/rigs/lifted_tube/connectivity.h"
#include "experiments/rigs/lifted_tube/lifted_tube_rig.h"
#include "experiments/rigs/load_case.h"
#include "tests/error_in.h"

namespace talus::rigs {
namespace case_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

FilledScene FillTube(const Case& c) {
  FilledScene made = FillVessel(c, LiftedTubeRig::VesselOf(c));
  made.scene.walls = LiftedTubeRig::Walls(c, 1.1 * made.filling.height);
  return made;
}

constexpr const char* kExample = TALUS_SOURCE_DIR "/examples/scenes/heap_case.json";

std::filesystem::path Write(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

std::string ErrorOf(const std::string& text) {
  return ErrorIn([&] { LoadCase(Write("heap_case_error.json", text)); });
}

TEST(Case, TheCompleteTextIsTheSameCase) {
  const Case rig_case = LoadCase(kExample);
  const std::string text = CaseText(rig_case);
  const Case again = LoadCase(Write("heap_case_complete.json", text));
  EXPECT_EQ(CaseText(again), text);
  EXPECT_EQ(CaseHash(again), CaseHash(rig_case));
}

TEST(Case, ASizeFileMovesIntoTheCase) {
  Write("heap_case_sizes.csv", "diameter (um),% under\n400,0\n500,50\n600,100\n");
  const Case rig_case = LoadCase(Write("heap_case_file.json", R"({"powder": {
    "material": {"density": 2500},
    "sizes": {"kind": "file", "file": "heap_case_sizes.csv"}, "mass": "0.5 g"}})"));
  EXPECT_EQ(rig_case.powder.sizes.kind, engine::SizeKind::kCumulative);
  EXPECT_THAT(CaseText(rig_case), ::testing::Not(HasSubstr("heap_case_sizes")));
}

// Whatever the two materials are; γ of a pair and of a wall is coarse-grained as the powder's (C1).
TEST(Case, PairsOfTheCaseActInItsScene) {
  const Case rig_case = LoadCase(Write("heap_case_pairs.json", R"({
    "powder": {"material": {"density": 2500},
               "sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.2 g"},
    "models": {"adhesion": "dmt"},
    "device": {"plate_material": {"sliding_friction": 0.9, "surface_energy": "0.3 mJ/m^2"}},
    "coarse_graining": {"scale_factor": 2},
    "pairs": [{"between": ["plate", "powder"], "sliding_friction": 0.25,
               "surface_energy": "1 mJ/m^2"}]})"));
  const engine::Scene scene = FillTube(rig_case).scene;
  ASSERT_EQ(scene.pairs.size(), 1u);
  EXPECT_TRUE(scene.pairs[0].Joins(kPowder, kFloor));
  EXPECT_DOUBLE_EQ(scene.pairs[0].stated.sliding_friction.value(), 0.25);
  EXPECT_DOUBLE_EQ(scene.pairs[0].stated.surface_energy.value(), 2e-3);
  EXPECT_FALSE(scene.pairs[0].stated.rolling_friction);
  EXPECT_DOUBLE_EQ(scene.materials[kFloor].surface_energy, 6e-4);
}

TEST(Case, HashIgnoresWhatDoesNotChangeTheHeap) {
  Case rig_case = LoadCase(kExample);
  const std::uint64_t hash = CaseHash(rig_case);
  rig_case.threads = 2;
  rig_case.checkpoint_interval = 1;
  EXPECT_EQ(CaseHash(rig_case), hash);
  rig_case.seed = 2;
  EXPECT_NE(CaseHash(rig_case), hash);
}

TEST(Case, EveryProblemIsListed) {
  EXPECT_THAT(
      ErrorOf(R"({"powder": {"material": {"density": 2500, "poisson_ratio": 0.6},
                          "sizes": {"kind": "mono"}, "mass": -1},
                          "device": {"tube_inner_diameter": "12 mm"},
                          "rules": {"heap": {"hold_time": 0}}, "num_views": 0, "sead": 1})"),
      AllOf(HasSubstr("powder.material.poisson_ratio"),
            HasSubstr("powder.sizes.diameter: is missing"),
            HasSubstr("powder.mass: is -1, must be positive"),
            HasSubstr("device.tube_inner_diameter: is 0.012 (\"12 mm\"), must not be above"),
            HasSubstr("rules.heap.hold_time"), HasSubstr("num_views"),
            HasSubstr("sead: is not known here; did you mean \"seed\"?")));
}

// It has no usual value, and what depends on it, from the time step to the mass, looks sound.
TEST(Case, ThePowdersDensityMustBeStatedThatOfAWallNeedNot) {
  const auto error_of = [](const std::string& material, const std::string& more = "") {
    return ErrorOf("{\"powder\": {" + material +
                   R"("sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.2 g"})" + more +
                   "}");
  };
  EXPECT_THAT(error_of(""), HasSubstr("powder.material: is missing"));
  EXPECT_THAT(error_of(R"("material": {"restitution": 0.5}, )"),
              HasSubstr("powder.material.density: is missing"));
  EXPECT_EQ(error_of(R"("material": {"density": 1500}, )",
                     R"(, "device": {"plate_material": {"sliding_friction": 0.2}})"),
            "");
}

TEST(Case, ADeviceThatCannotHoldTheMassIsRefused) {
  const std::string powder =
      R"("powder": {"material": {"density": 2500},
  "sizes": {"kind": "mono", "diameter": "0.5 mm"}, "mass": "1 g"})";
  EXPECT_EQ(ErrorOf("{" + powder + "}"), "");
  EXPECT_THAT(ErrorOf("{" + powder + R"(, "device": {"tube_length": "2 mm"}})"),
              HasSubstr("device.tube_length: is 0.002 (\"2 mm\"), cannot hold the mass"));
  EXPECT_THAT(ErrorOf("{" + powder + R"(, "coarse_graining": {"scale_factor": 8}})"),
              HasSubstr("must be above three (scaled) grain diameters"));
}

// The engine refused it by "motion", after the powder had been filled in.
TEST(Case, ASpeedThatWouldPassGrainsUnseenIsRefusedByItsKeyWithWhatHolds) {
  const auto error_of = [](const std::string& speed, const std::string& modulus,
                           const std::string& fraction) {
    return ErrorOf(R"({"powder": {"material": {"density": 2500, "poisson_ratio": 0.25,
      "youngs_modulus": ")" +
                   modulus + R"("}, "sizes": {"kind": "mono", "diameter": "1 mm"},
      "mass": "0.3 g"}, "rayleigh_fraction": )" +
                   fraction + R"(, "device": {"lift_velocity": ")" + speed + R"("}})");
  };
  EXPECT_THAT(error_of("2 m/s", "50 kPa", "0.3"),
              AllOf(HasSubstr("device.lift_velocity: is 2 (\"2 m/s\"), in m/s, moves the tube by "
                              "0.7265 radii of the smallest grain"),
                    HasSubstr("lower it to 1.35 m/s, raise youngs_modulus 2.2 times, or lower "
                              "rayleigh_fraction to 0.202")));
  EXPECT_EQ(error_of("1.35 m/s", "50 kPa", "0.3"), "");
  EXPECT_EQ(error_of("2 m/s", "110 kPa", "0.3"), "");
  EXPECT_EQ(error_of("2 m/s", "50 kPa", "0.202"), "");
  EXPECT_THAT(ErrorOf(R"({"powder": {"material": {"density": 4430, "youngs_modulus": "50 kPa"},
    "sizes": {"kind": "mono", "diameter": "0.2 mm"}, "mass": "8 mg"},
    "rig": {"kind": "spreading", "speed": "1.5 m/s"}})"),
              HasSubstr("rig.speed: is 1.5 (\"1.5 m/s\"), in m/s, moves the spreader by"));
}

TEST(HeapScene, CoarseGrainingScalesDiametersAndSurfaceEnergyAndKeepsTheMass) {
  Case rig_case = LoadCase(kExample);
  rig_case.powder.material.surface_energy = 1e-4;
  const FilledScene fine = FillTube(rig_case);
  rig_case.coarse_graining.scale_factor = 2;
  const FilledScene coarse = FillTube(rig_case);
  const auto mass = [&](const FilledScene& made) {
    double volume = 0;
    for (const engine::Particle& p : made.scene.particles) volume += std::pow(p.radius, 3);
    return 4.0 / 3 * std::numbers::pi * volume * rig_case.powder.material.density;
  };
  EXPECT_NEAR(static_cast<double>(fine.scene.particles.size()) /
                  static_cast<double>(coarse.scene.particles.size()),
              8, 0.1);  // a few hundred grains: one of them is 0.3 %
  EXPECT_NEAR(mass(fine) / mass(coarse), 1, 0.005);
  EXPECT_EQ(coarse.scene.materials[0].surface_energy, 2e-4);
  rig_case.coarse_graining.surface_energy_exponent = 2;
  EXPECT_EQ(UsedMaterial(rig_case).surface_energy, 4e-4);
  EXPECT_EQ(fine.scene.materials[0].youngs_modulus, coarse.scene.materials[0].youngs_modulus);
}

TEST(HeapScene, WallsTakeThePowdersMaterialWhereTheyHaveNoneOfTheirOwn) {
  Case rig_case = LoadCase(kExample);
  rig_case.materials.floor = WallMaterial{.sliding_friction = 0.9};
  const engine::Scene scene = FillTube(rig_case).scene;
  const auto& tube = scene.materials[static_cast<std::size_t>(scene.walls[kTube].material)];
  const auto& plate = scene.materials[static_cast<std::size_t>(scene.walls[kPlate].material)];
  EXPECT_EQ(tube.sliding_friction, rig_case.powder.material.sliding_friction);
  EXPECT_EQ(plate.sliding_friction, 0.9);
  EXPECT_EQ(plate.rolling_friction, rig_case.powder.material.rolling_friction);
}

TEST(HeapScene, WarnsWhenTheGrainsAreTooFewAcrossThePlate) {
  Case rig_case = LoadCase(kExample);
  rig_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 0.3e-3};  // 33 across
  EXPECT_TRUE(CaseWarnings(rig_case).empty());
  rig_case.coarse_graining.scale_factor = 2;  // 17 across
  EXPECT_THAT(CaseWarnings(rig_case).at(0),
              HasSubstr("only 16.7 grains across the plate at scale factor 2: a smaller scale "
                        "factor would say more (30 or more are advised)"));
  rig_case.coarse_graining.scale_factor = 3;  // 11 across
  EXPECT_THAT(CaseWarnings(rig_case).at(0), HasSubstr("COARSE"));
  EXPECT_TRUE(SetUpWarnings(rig_case).empty());
  rig_case.coarse_graining.scale_factor = 1;
  rig_case.powder.sizes.diameter = 0.5e-3;  // nothing finer can be simulated
  EXPECT_THAT(CaseWarnings(rig_case).at(0), HasSubstr("a wider tube and plate would say more"));
}

// A strong rolling dashpot shortens the step of what is planned and of what is run alike.
TEST(HeapScene, TakesAShorterStepWhereRollingDampingNeedsIt) {
  Case c = LoadCase(kExample);
  EXPECT_EQ(StepFraction(c), kUsualRayleighFraction);
  c.powder.material.rolling_friction = 1;
  c.powder.material.rolling_damping = 1;
  const double fraction = StepFraction(c);
  EXPECT_LT(fraction, 0.5 * kUsualRayleighFraction);
  EXPECT_THAT(SetUpWarnings(c), Contains(HasSubstr("rolling dashpot")));
  Case stiff = c;
  stiff.powder.material.rolling_friction = 5;
  stiff.powder.material.rolling_damping = 0.05;
  EXPECT_LT(StepFraction(stiff), 0.75 * kUsualRayleighFraction);
  EXPECT_THAT(SetUpWarnings(stiff), Contains(HasSubstr("a smaller rolling_friction takes fewer")));
  EXPECT_EQ(FillTube(c).scene.rayleigh_fraction, fraction);
  const double radius =
      c.coarse_graining.scale_factor * engine::SizeCurve(c.powder.sizes).smallest() / 2;
  EXPECT_EQ(EstimatePowder(c).time_step,
            fraction * engine::RayleighTime(c.powder.material, radius));
  c.models.rolling = engine::Rolling::kEpsd2;  // has no dashpot
  EXPECT_EQ(StepFraction(c), kUsualRayleighFraction);
}

// Soft grains that hardly bounce do, with any rolling law.
TEST(HeapScene, TakesAShorterStepWhereTheDashpotOfFrictionNeedsIt) {
  Case c = LoadCase(kExample);
  c.powder.material.youngs_modulus = 1e5;
  c.powder.material.restitution = 0.2;
  for (const auto rolling : {engine::Rolling::kEpsd, engine::Rolling::kNone}) {
    c.models.rolling = rolling;
    EXPECT_LT(StepFraction(c), 0.7 * kUsualRayleighFraction);
    EXPECT_THAT(SetUpWarnings(c), Contains(HasSubstr("friction's dashpot")));
  }
  c.powder.material.restitution = 0.9;
  EXPECT_EQ(StepFraction(c), kUsualRayleighFraction);
}

// Openings that the scale factor closes. By (D - 1.4 d)^1.5 a slot of 9 mm lets grains of 3 mm run
// out at half the rate of those of 1 mm; the default gap is that of the true powder.
TEST(HeapScene, WarnsWhenTheScaleFactorClosesAnOpening) {
  Case rig_case = LoadCase(kExample);
  rig_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 1e-3};
  rig_case.rig.kind = RigKind::kDrawDown;
  rig_case.rig.draw_down.slot = 9e-3;
  EXPECT_TRUE(SetUpWarnings(rig_case).empty());
  rig_case.coarse_graining.scale_factor = 3;
  EXPECT_THAT(SetUpWarnings(rig_case).at(0), HasSubstr("COARSE: the slot is 3 grains across"));
  EXPECT_THAT(SetUpWarnings(rig_case).at(0), HasSubstr("at 50 % of the rate"));
  rig_case.rig.kind = RigKind::kSpreading;
  EXPECT_THAT(SetUpWarnings(rig_case).at(0), HasSubstr("the spreader's gap is 1 of the largest"));
  rig_case.coarse_graining.scale_factor = 1.5;
  EXPECT_TRUE(SetUpWarnings(rig_case).empty());
}

TEST(HeapScene, WarnsWhenWhatIsToBeTappedIsPlacedDensely) {
  Case rig_case = LoadCase(kExample);
  rig_case.rig.kind = RigKind::kTappedDensity;
  EXPECT_THAT(CaseWarnings(rig_case), Contains(HasSubstr("FILLED DENSELY")));
  rig_case.filling.kind = FillingKind::kPour;
  EXPECT_THAT(CaseWarnings(rig_case), Not(Contains(HasSubstr("DENSELY"))));
}

// Grains of 0.3 mm, 2000 kg/m³, in a tube of 10 mm: F_po / (d² ρ g D) = πγ/(d ρ g D) is 0.2 at
// γ = 3.75e-3 J/m², whatever the scale factor.
TEST(HeapScene, WarnsWhenACohesivePowderIsPlacedDensely) {
  Case rig_case = LoadCase(kExample);
  rig_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 0.3e-3};
  rig_case.powder.material.density = 2000;
  rig_case.models.adhesion = engine::Adhesion::kJkr;
  for (const double scale_factor : {1.0, 1.1}) {
    rig_case.coarse_graining.scale_factor = scale_factor;
    rig_case.powder.material.surface_energy = 3.6e-3;
    EXPECT_TRUE(CaseWarnings(rig_case).empty());
    rig_case.powder.material.surface_energy = 3.9e-3;
    EXPECT_THAT(CaseWarnings(rig_case).at(0), HasSubstr("COHESIVE"));
  }
  rig_case.filling.kind = FillingKind::kPour;
  EXPECT_TRUE(CaseWarnings(rig_case).empty());
  rig_case.filling.kind = FillingKind::kDense;
  rig_case.models.adhesion = engine::Adhesion::kNone;
  EXPECT_THAT(CaseWarnings(rig_case), Not(Contains(HasSubstr("COHESIVE"))));
}

TEST(DeviceText, HasWhatTheTestIsMadeWithInTheBenchsUnits) {
  Case c;
  c.rig.kind = RigKind::kShearCell;
  c.rig.shear_cell.stresses = {200, 1e3, 2.5e3};
  EXPECT_EQ(DeviceText(c.rig),
            "shear cell: stresses 200 Pa, 1 kPa and 2.5 kPa, diameter 25 mm, speed 2 cm/s");
  c.rig.kind = RigKind::kDrum;
  EXPECT_EQ(DeviceText(c.rig), "drum: diameter 60 mm, width 14 mm, speed 10 rpm");
  EXPECT_EQ(QuantityText(10 * std::numbers::pi / 180, base::Dimension::kAngularVelocity),
            "10 deg/s");
}

}  // namespace case_test
}  // namespace talus::rigs
