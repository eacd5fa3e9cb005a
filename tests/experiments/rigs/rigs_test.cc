// Each rig against a behaviour that is known of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/observables/shown_number.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/surface.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/rigs/rig_run.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/metrics.h"
#include "tests/experiments/rigs/rig_case.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::rigs {
namespace rigs_test {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;

Case Tapped(int count) {
  Case c = CaseOf(RigKind::kTappedDensity, 0.6, 0.2, 0.8e-3);
  c.rig.tapped_density = {.diameter = 0.01, .taps = {.count = count, .height = 1e-3}};
  c.filling.kind = FillingKind::kPour;
  return c;
}

// At 1 kPa the bed alone presses its lowest grains in; at 3 kPa it holds.
TEST(TappedDensity, GrainsTooSoftForTheTapsAreAFailureAndNoDensity) {
  Case c = Tapped(3);
  c.filling = {};
  c.powder.material.youngs_modulus = 1e3;
  c.rig.tapped_density.taps.height = 0.03e-3;
  try {
    const auto rig = Ran(c);
    ADD_FAILURE() << rig->ResultText(rig->Grains(), {});
  } catch (const base::Error& error) {
    EXPECT_THAT(error.what(), AnyOf(HasSubstr("goes through the wall \"floor\""),
                                    HasSubstr("goes through the wall \"cylinder\"")));
  }
}

// (δ/R)^(5/2) = (5π/4) ρ 2gh/E* on the floor: 0.28 at 0.11 m for these grains.
TEST(TappedDensity, TapsThatPressTheGrainsIntoEachOtherAreRefused) {
  const auto problems_at = [](double height) {
    Case c = Tapped(3);
    c.rig.tapped_density.taps = {.count = 3, .height = height, .interval = 2};
    base::Problems problems;
    ValidateCase(c, problems);
    return problems.list();
  };
  EXPECT_TRUE(problems_at(0.05).empty());
  for (const double height : {0.3, 1.0}) {
    const auto problems = problems_at(height);
    ASSERT_EQ(problems.size(), 1);
    EXPECT_EQ(problems.front().path, "rig.taps.height");
    EXPECT_THAT(problems.front().message, HasSubstr("mm at most, or raise youngs_modulus"));
  }
}

// Frictional spheres pour to 0.55 to 0.60 and are tapped towards random close packing, 0.64
// [knight1995]; the cylinder, ten grains wide, takes about 0.03 of that away.
TEST(TappedDensity, TapsPackThePowderTowardsRandomClosePacking) {
  const Case few = Tapped(2);
  const Case many = Tapped(20);
  const auto after_few = Ran(few);
  const auto after_many = Ran(many);
  const double poured = Value(many, *after_many, "poured_density_kg_per_m3") / kDensity;
  const double tapped = Value(many, *after_many, "tapped_solid_fraction");
  EXPECT_GT(poured, 0.48);
  EXPECT_LT(poured, 0.58);
  EXPECT_GT(tapped, poured + 0.015);
  EXPECT_GT(tapped, Value(few, *after_few, "tapped_solid_fraction"));
  EXPECT_LT(tapped, 0.64);
  EXPECT_NEAR(Value(many, *after_many, "hausner_ratio"), tapped / poured, 1e-12);
}

// A layer of grains that do not roll slides on its floor as a block: tan(angle) = μ, the pair's
// harmonic mean of 1 and 0.2, 1/3. What keeps it at the walls is little, as these are smooth.
TEST(TiltingBox, AFrictionalBlockSlidesAtItsAngleOfFriction) {
  // While it slides half a grain the box turns on, by 1.7 and 3 degrees at these rates: no part of
  // the angle.
  for (const double rate : {0.3, 0.7}) {
    Case c = CaseOf(RigKind::kTiltingBox, 1, 2, 0.4e-3);
    c.rig.tilting_box = {.length = 0.025, .width = 0.012, .lip_height = 0.0, .rate = rate};
    c.materials.walls = WallMaterial{.sliding_friction = 0};
    c.materials.floor = WallMaterial{.sliding_friction = 0.2};
    const auto rig = Ran(c);
    EXPECT_NEAR(Value(c, *rig, "angle_deg"), std::atan(1.0 / 3) * 180 / std::numbers::pi, 0.8);
  }
}

TEST(TiltingBox, WhatDoesNotSlideHasNoAngle) {
  Case c = CaseOf(RigKind::kTiltingBox, 1, 1, 0.4e-3);
  c.rig.tilting_box = {.length = 0.025, .width = 0.012, .rate = 0.5, .largest_angle = 0.05};
  const auto rig = Ran(c);
  const auto result = nlohmann::json::parse(rig->ResultText({}, {}));
  EXPECT_FALSE(result["observables"].contains("angle_deg"));
  EXPECT_THAT(std::string(result["undefined"]["angle_deg"]), HasSubstr("nothing slid up to 3 deg"));
}

// A trial keeps both under their names.
TEST(Observables, ShareNoNameWithTheMetricsOfPictures) {
  const std::vector<std::string> metrics = imaging::MetricNames();
  for (const ObservableInfo& info : kObservables) {
    EXPECT_EQ(std::count(metrics.begin(), metrics.end(), MetricName(info.observable)), 0)
        << info.key;
  }
}

// Every rig goes on from a checkpoint with the same bits.
class EveryRig : public ::testing::TestWithParam<RigKind> {};

Case Small(RigKind kind) {
  Case c = CaseOf(kind, 0.5, 0.1, 0.15e-3);
  c.rig.tapped_density = {.diameter = 0.006, .taps = {.count = 1}};
  c.rig.column_collapse = {.length = 0.006, .width = 0.005};
  c.rig.tilting_box = {.length = 0.008, .width = 0.005, .rate = 2};
  c.rig.draw_down = {.length = 0.012, .width = 0.005, .slot = 0.006, .height = 0.008};
  c.rig.drum = {.diameter = 0.012, .width = 0.005, .speed = 10, .start_turns = 0.1, .turns = 0.1};
  c.rig.orifice_flow = {.diameter = 0.008, .orifice = 0.005, .cone_angle = 1, .arch_time = 0.05};
  c.rig.funnel_heap = {.plate_diameter = 0.008, .height = 0.008, .outlet = 0.004};
  c.rig.spreading = {.spreader = Spreader::kRoller,
                     .gap = 2.5e-3,
                     .speed = 0.2,
                     .length = 0.012,
                     .width = 0.006,
                     .feed = 0.01,
                     .bed = 2.5e-3,
                     .roller_diameter = 0.012,
                     .turning = 33};
  if (IsFilmed(kind)) c.rig.camera = {.frames = 5, .interval = 0.005};
  c.frame = Filmed().frame;
  if (kind == RigKind::kFunnelHeap) c.filling.kind = FillingKind::kPour;
  c.rules.heap.max_time = 0.3;
  return c;
}

// How long it took, and the checksum that covers it, differ from run to run.
nlohmann::json WithoutTiming(const std::string& text) {
  auto result = nlohmann::json::parse(text);
  result.erase("timing");
  result.erase("checksum_xxh3");
  return result;
}

// The powder of docs/validation.md's heaps with a surface energy, coarse so that it takes a second.
// What a trial costs is said before it is run: pouring counts, and the grains that leave. The mean
// of six seeds takes 0.89 of the time announced, single heaps 0.85 to 0.97, by how they come to
// rest, which every instruction set does by itself.
TEST(EstimateOfACase, MeetsWhatAPouredCohesiveHeapTakes) {
  Case c;
  c.powder.material = {.density = 4386,
                       .youngs_modulus = 26.25e6,
                       .poisson_ratio = 0.342,
                       .sliding_friction = 0.4,
                       .rolling_friction = 0.1,
                       .surface_energy = 6e-3};
  c.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 0.4e-3};
  c.powder.mass = 1.602e-3;
  c.models.adhesion = engine::Adhesion::kDmt;
  c.filling.kind = FillingKind::kPour;
  c.coarse_graining.scale_factor = 2;
  c.rig.lifted_tube.lift_velocity = 0.05;
  const CaseSize expected = EstimateCase(c);
  const auto rig = Ran(c);
  EXPECT_NEAR(expected.simulated_time / rig->simulation().time(), 1.1, 0.15);
  EXPECT_NEAR(expected.grain_time / expected.time_step / rig->Progress().particle_steps, 1.1, 0.2);
}

// What a pair states would count for nothing where no wall were of the body's material.
TEST_P(EveryRig, ABodyIsThereOnceItsPairIsStated) {
  Case by_material = Small(GetParam());
  by_material.materials.floor = WallMaterial{};
  Case by_pair = Small(GetParam());
  PairWith(by_pair.pairs, kFloor).sliding_friction = 0.2;
  EXPECT_EQ(WallMaterialsOf(by_pair), WallMaterialsOf(by_material));
  EXPECT_THAT(WallMaterialsOf(by_pair), Contains(kFloor));
}

TEST_P(EveryRig, GoesOnFromACheckpointWithTheSameBits) {
  const Case c = Small(GetParam());
  const auto whole = Ran(c);
  auto first = MakeRig(c);
  const double half = whole->simulation().time() * 0.6;
  while (first->simulation().time() < half) first->Advance();
  auto second = RestoreRig(c, first->StateLine(),
                           engine::Simulation::Restore(first->simulation().Checkpoint()));
  while (second->Advance()) {
  }
  EXPECT_EQ(second->simulation().step(), whole->simulation().step());
  EXPECT_EQ(WithoutTiming(second->ResultText(second->Grains(), {})),
            WithoutTiming(whole->ResultText(whole->Grains(), {})));
  // How long these few grains take to come to rest nobody knows within a half.
  EXPECT_GT(EstimateCase(c).simulated_time, 0.5 * whole->simulation().time());
  EXPECT_LT(EstimateCase(c).simulated_time, 2 * whole->simulation().time());
}
INSTANTIATE_TEST_SUITE_P(Rigs, EveryRig,
                         ::testing::Values(RigKind::kLiftedTube, RigKind::kTappedDensity,
                                           RigKind::kColumnCollapse, RigKind::kTiltingBox,
                                           RigKind::kDrawDown, RigKind::kDrum,
                                           RigKind::kOrificeFlow, RigKind::kFunnelHeap,
                                           RigKind::kSpreading),
                         [](const auto& rig) { return std::string(base::NameOf(rig.param)); });

TEST(RigRun, WritesTheContractOfATrialFolder) {
  ScratchFolder scratch;
  Case c = Small(RigKind::kColumnCollapse);
  c.rig.camera.reset();
  c.frame = imaging::Frame{.width = 300,
                           .height = 100,
                           .pixel_size = 1e-4,
                           .center_x = 60,
                           .baseline = 90,
                           .plate_diameter = 0.006};
  RigRun first(c, scratch.path());
  for (int i = 0; i < 40; ++i) first.Advance();
  RigRun second(c, scratch.path(), engine::Unpack(first.Checkpoint({})));
  while (second.Advance()) {
  }
  second.WriteResults({});
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "heap.vtp"));
  const auto result = nlohmann::json::parse(base::ReadFile(scratch.path() / "result.json"));
  EXPECT_EQ(result["status"], "ok");
  EXPECT_EQ(result["kind"], "column_collapse");
  const double runout = result["observables"]["runout_m"];
  // The picture shows grains that far from the middle of the column, 3 mm + runout, and a grain or
  // two farther.
  const imaging::GrayImage image = imaging::ReadGrayImage(scratch.path() / "profile.png");
  int right = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) == 0) right = std::max(right, x);
    }
  }
  EXPECT_GE(right, 60 + static_cast<int>((0.003 + runout) / 1e-4) - 1);
}

TEST(RigOptions, OnlyTheKeysOfTheKindAreKnown) {
  const std::string powder = R"({"powder": {"material": {"density": 2500},
                                "sizes": {"kind": "mono", "diameter": "1 mm"},
                                "mass": "1 g"}, "rig": )";
  EXPECT_EQ(ErrorOf((powder + R"({"kind": "drum", "speed": "20 rpm"}})").c_str()), "");
  EXPECT_THAT(ErrorOf((powder + R"({"kind": "drum", "slot": "5 mm"}})").c_str()),
              HasSubstr("rig.slot: is not known here"));
  EXPECT_THAT(ErrorOf((powder + R"({"kind": "barrel"}})").c_str()), HasSubstr("\"drum\""));
  EXPECT_THAT(
      ErrorOf((powder + R"({"kind": "orifice_flow", "orifice": "40 mm"}})").c_str()),
      HasSubstr("rig.orifice: is 0.04 (\"40 mm\"), must be below the diameter of the cylinder"));
  EXPECT_THAT(ErrorOf((powder + R"({"kind": "funnel_heap"}})").c_str()),
              HasSubstr("must be \"pour\""));
  EXPECT_THAT(ErrorOf((powder + R"({"kind": "funnel_heap", "camera": {"frames": 2,
                       "interval": "1 ms"}}})")
                          .c_str()),
              HasSubstr("rig.camera: has nothing to film"));
  EXPECT_THAT(ErrorOf((powder + R"({"kind": "draw_down", "slot": "1 mm"}})").c_str()),
              HasSubstr("must be above two (scaled) grain diameters"));
  EXPECT_THAT(
      ErrorOf(
          (powder + R"({"kind": "tapped_density"}, "filling": {"taps": {"count": 3}}})").c_str()),
      HasSubstr("filling.taps: are not of this rig"));
}

TEST(RigOptions, ARigWithoutKindIsRefused) {
  const std::string text = R"({"powder": {"material": {"density": 2500},
                              "sizes": {"kind": "mono", "diameter": "1 mm"},
                              "mass": "1 g"}, "rig": {}})";
  EXPECT_THAT(ErrorOf(text.c_str()), HasSubstr("rig.kind: is missing"));
}

// The page's rows name what the table of each rig does.
TEST(RigList, TheDocumentedObservablesAreThoseOfTheTables) {
  const std::string page = base::ReadFile(TALUS_SOURCE_DIR "/docs/rigs.md");
  for (const auto& [name, kind] : base::Names<RigKind>::kList) {
    Case c;
    c.rig.kind = kind;
    std::string row = "| `" + std::string(name) + "` | ";
    for (const RigObservable& measured : EntryOf(c).observables) {
      row += (row.ends_with("| ") ? "`" : ", `") + MetricName(measured.observable) + "`";
    }
    EXPECT_THAT(page, HasSubstr(row + " |"));
  }
}

TEST(Surface, TheSlopeOfARampIsItsAngle) {
  std::vector<engine::Particle> grains;
  for (int i = 0; i < 100; ++i) {
    grains.push_back({.id = i, .radius = 0.1, .position = {0.1 * i, 0, -0.05 * i}});
  }
  const auto surface = SurfaceOf(grains, {.from = 0, .to = 10, .width = 0.5});
  EXPECT_NEAR(AngleOf(Observable::kAngle, surface).value, std::atan(0.5) * 180 / std::numbers::pi,
              0.2);
  EXPECT_FALSE(AngleOf(Observable::kAngle, {}).undefined.empty());
  // In a bed from -4.95 to -0.95 what lies below -1.35 has moved: the strips from x = 3 on.
  const auto sunken = Sunken(surface, {.floor = -4.95, .height = 4});
  EXPECT_NEAR(sunken.front().x, 3.25, 1e-9);
  EXPECT_EQ(sunken.back().x, surface.back().x);
  EXPECT_NEAR(MassQuantile(grains, 0.5, [](const auto& p) { return p.position.x; }), 4.95, 0.06);
}

// Three small grains and a large one, which has eight of eleven parts of the mass.
TEST(Surface, AQuantileIsOfTheMassAndNotOfTheNumber) {
  const std::vector<engine::Particle> grains{{.radius = 1, .position = {0, 0, 0}},
                                             {.radius = 1, .position = {1, 0, 0}},
                                             {.radius = 1, .position = {2, 0, 0}},
                                             {.radius = 2, .position = {3, 0, 0}}};
  const auto along = [](const engine::Particle& p) { return p.position.x; };
  EXPECT_EQ(MassQuantile(grains, 0.25, along), 2);
  EXPECT_EQ(MassQuantile(grains, 0.5, along), 3);
}

TEST(Surface, TwoPlacesAreNoSlope) {
  const std::vector<SurfacePoint> surface{{.x = 0, .top = 0}, {.x = 1, .top = 1}};
  EXPECT_FALSE(SlopeOf(surface).has_value());
}

TEST(EstimateOfACase, TapsOfTheFillingTakeTheirTime) {
  Case c = CaseOf(RigKind::kColumnCollapse, 0.5, 0.1, 0.5e-3);
  const double without = SimulatedTime(c, 1);
  c.filling.taps = TapRule{.count = 10, .interval = 0.2};
  EXPECT_NEAR(SimulatedTime(c, 1) - without, 2, 1e-12);
}

TEST(TiltingBox, WhatLeavesOverTheLipIsWeighed) {
  Case c = CaseOf(RigKind::kTiltingBox, 0.5, 0.1, 0.4e-3);
  c.rig.tilting_box = {.length = 0.012, .width = 0.006, .lip_height = 0.0, .rate = 1.5};
  const auto rig = Ran(c);
  const double left = Value(c, *rig, "mass_left_kg");
  double stays = 0;
  for (const engine::Particle& p : rig->simulation().Particles()) {
    EXPECT_LT(p.position.x, 0.006 + 1.2e-3);
    stays += kDensity * 4 / 3 * std::numbers::pi * std::pow(p.radius, 3);
  }
  EXPECT_GT(left, 0);
  EXPECT_GT(stays, 0);
  EXPECT_NEAR(left + stays, 0.4e-3, 2e-6);
  const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("of the powder fell off the open end"));
}

TEST(Observables, NumbersAreShownInTheUnitsThatPeopleRead) {
  EXPECT_EQ(ShownNumber("discharge_rate_kg_per_s", 1.23e-3), "1.23 g/s");
  EXPECT_EQ(ShownNumber("mass_fallen_kg", 5.04e-6), "5.04 mg");
  EXPECT_EQ(ShownNumber("runout_m", 0.0125), "12.5 mm");
  EXPECT_EQ(ShownNumber("angle_deg", 33.25), "33.25°");
  EXPECT_EQ(ShownNumber("tapped_density_kg_per_m3", 1480), "1480 kg/m³");
}

// An error of 200 % was shown as one of 100 %.
TEST(Observables, ErrorsAreShownBeyondTheBoundsOfTheirValues) {
  EXPECT_EQ(ShownNumber("coverage", 1.02), "1");
  EXPECT_EQ(ShownError("coverage", 2), "2");
  EXPECT_EQ(ShownError("angle_deg", 120), "120°");
  EXPECT_EQ(ShownError("mass_fallen_kg", 5.04e-7, 2), "0.5 mg");
}

}  // namespace rigs_test
}  // namespace talus::rigs
