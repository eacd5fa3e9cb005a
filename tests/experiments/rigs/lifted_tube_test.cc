#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/run/bed.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/lifted_tube/lifted_tube_rig.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace lifted_tube_test {

// About 150 grains of 1 mm, soft so that a test takes a second.
Case Coarse(double sliding_friction, double rolling_friction) {
  Case c;
  c.powder.material = {.density = 2500,
                       .youngs_modulus = 1e6,
                       .restitution = 0.5,
                       .sliding_friction = sliding_friction,
                       .rolling_friction = rolling_friction};
  c.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 1e-3};
  c.powder.mass = 0.2e-3;
  c.rig.lifted_tube.lift_velocity = 0.05;
  c.rules.heap.max_time = 0.3;
  return c;
}

// At time 0.
engine::Scene SceneOf(const Case& c) {
  FilledScene made = FillVessel(c, LiftedTubeRig::VesselOf(c));
  made.scene.walls = LiftedTubeRig::Walls(c, 1.1 * made.filling.height);
  return made.scene;
}

struct Outcome {
  std::unique_ptr<Rig> rig;
  std::vector<engine::Particle> heap;
  double height = 0;  // [m]

  PhaseEnd EndOf(const char* phase) const { return rig->RecordOf(phase).reason; }
  std::int64_t Count(const char* name) const {
    return nlohmann::json::parse(rig->ResultText(heap, {}))["counts"][name];
  }
};

Outcome RunToTheEnd(const Case& c) {
  Outcome outcome{.rig = MakeRig(c), .heap = {}};
  while (outcome.rig->Advance()) {
  }
  outcome.heap = outcome.rig->Grains();
  for (const engine::Particle& p : outcome.heap) {
    outcome.height = std::max(outcome.height, p.position.z + p.radius);
  }
  return outcome;
}

TEST(LiftedTube, RoughGrainsHeapUpAndSlipperyOnesRunOff) {
  const Outcome rough = RunToTheEnd(Coarse(0.8, 0.5));
  const Outcome slippery = RunToTheEnd(Coarse(0.02, 0));
  // 150 grains on a plate ten grains wide: a cone of three layers against, at most, one.
  EXPECT_GT(rough.heap.size(), 2 * slippery.heap.size());
  EXPECT_GT(rough.height, 2.4e-3);
  EXPECT_LT(slippery.height, 1.6e-3);
  EXPECT_EQ(rough.EndOf("settling"), PhaseEnd::kAtRest);
  EXPECT_EQ(rough.EndOf("lifting"), PhaseEnd::kCleared);
  EXPECT_EQ(rough.Count("carried_by_tube"), 0);
}

// A balance sees every grain once: on the plate, or fallen; this powder sticks to no tube.
TEST(LiftedTube, WhatLiesOnThePlateAndWhatFellIsWhatWasFilled) {
  const Case c = Coarse(0.3, 0.05);
  const Outcome run = RunToTheEnd(c);
  const auto result = nlohmann::json::parse(run.rig->ResultText(run.heap, {}));
  const auto& observables = result["observables"];
  const double on_plate = observables["mass_on_plate_kg"];
  const double fallen = observables["mass_fallen_kg"];
  const double num_fallen = observables["num_fallen"];
  EXPECT_GT(num_fallen, 0);
  // Grains of one size: masses are in the ratio of the counts.
  const double grain = (on_plate + fallen) / static_cast<double>(run.rig->state().num_filled);
  EXPECT_NEAR(fallen, grain * num_fallen, 1e-9 * fallen);
  EXPECT_NEAR(on_plate + fallen, c.powder.mass, grain);  // to a whole number of grains
}

// Grains of half a millimetre are simulated twice as large: one stands for eight, which is what
// somebody would count.
TEST(LiftedTube, FallenGrainsAreCountedAsTrueOnes) {
  Case c = Coarse(0.3, 0.05);
  c.powder.sizes.diameter = 0.5e-3;
  c.coarse_graining.scale_factor = 2;
  const Outcome run = RunToTheEnd(c);
  const auto observables = nlohmann::json::parse(run.rig->ResultText(run.heap, {}))["observables"];
  const double fallen = observables["mass_fallen_kg"];
  ASSERT_GT(fallen, 0);
  const double true_grain = 2500 * std::numbers::pi / 6 * std::pow(0.5e-3, 3);
  EXPECT_NEAR(observables["num_fallen"].get<double>(), fallen / true_grain,
              1e-6 * fallen / true_grain);
}

TEST(LiftedTube, NothingFallsBeforeTheTubeIsLifted) {
  const auto made = MakeRig(Coarse(0.5, 0.1));
  Rig& rig = *made;
  while (rig.phase_name() == "settling") rig.Advance();
  EXPECT_EQ(rig.simulation().num_particles(), rig.state().num_filled);
  // Dense enough a filling that settling is a small change.
  double top = 0;
  for (const engine::Particle& p : rig.simulation().Particles()) {
    top = std::max(top, p.position.z + p.radius);
  }
  EXPECT_GT(top, 0.8 * rig.state().filled_height);
  EXPECT_LT(rig.RecordOf("settling").end_time, 0.15);  // a drop over the whole height takes 0.03 s
}

TEST(LiftedTube, ACapEndsAPhaseAndIsReported) {
  Case c = Coarse(0.5, 0.1);
  c.rules.settling.max_time = 0.01;
  c.rules.settling.hold_time = 0.01;
  c.rules.heap.max_time = 0.012;
  c.rules.heap.hold_time = 0.012;
  c.rules.heap.energy_fraction = 1e-30;
  c.rules.lift_max_time = 0.02;
  const Outcome capped = RunToTheEnd(c);
  EXPECT_EQ(capped.EndOf("settling"), PhaseEnd::kTimeCap);
  EXPECT_EQ(capped.EndOf("lifting"), PhaseEnd::kTimeCap);
  EXPECT_EQ(capped.EndOf("coming to rest"), PhaseEnd::kTimeCap);
  // A criterion is looked at every few milliseconds.
  EXPECT_NEAR(capped.rig->RecordOf("lifting").end_time - capped.rig->RecordOf("lifting").start_time,
              0.02, 0.006);
}

TEST(LiftedTube, WhatSticksToTheTubeIsCarriedAwayAndCounted) {
  Case c = Coarse(0.8, 0.5);
  c.models.adhesion = engine::Adhesion::kDmt;
  // Pull-off over weight: 4πγR/(mg) = 240 with itself and the tube; the plate does not hold it.
  c.powder.material.surface_energy = 0.5;
  c.materials.floor = WallMaterial{.surface_energy = 0};
  const Outcome sticky = RunToTheEnd(c);
  EXPECT_GT(sticky.Count("carried_by_tube"), sticky.Count("filled") / 2);
  const auto result = nlohmann::json::parse(sticky.rig->ResultText(sticky.rig->Grains(), {}));
  EXPECT_THAT(result["warnings"].dump(),
              ::testing::HasSubstr("stuck in the tube and left with it"));
  EXPECT_EQ(sticky.EndOf("lifting"), PhaseEnd::kCleared);
}

// Fines stick to the tube: they are more of the grains that it carries than of their mass.
TEST(LiftedTube, WhatTheTubeCarriesIsWeighed) {
  Case c = Coarse(0.5, 0.2);
  c.models.adhesion = engine::Adhesion::kDmt;
  c.powder.material.surface_energy = 0.02;
  c.powder.sizes = {.kind = engine::SizeKind::kClasses,
                    .diameters = {0.5e-3, 0.51e-3, 1e-3, 1.01e-3},
                    .shares = {0.3, 0, 0.7}};
  c.materials.walls = WallMaterial{.surface_energy = 2};
  c.materials.floor = WallMaterial{.surface_energy = 0};
  const Outcome run = RunToTheEnd(c);
  const LiftedTubeMemory& memory = dynamic_cast<const LiftedTubeRig&>(*run.rig).memory();
  const double on_plate = Value(c, *run.rig, "mass_on_plate_kg");
  const double fallen = Value(c, *run.rig, "mass_fallen_kg");
  const double filled = FilledVolume(c, run.rig->state().num_filled) * 2500;
  ASSERT_GT(memory.num_carried, 0);
  EXPECT_NEAR(on_plate + fallen + memory.mass_carried, filled, 1e-9 * filled);
  const auto result = nlohmann::json::parse(run.rig->ResultText(run.rig->Grains(), {}));
  const bool is_much = memory.mass_carried > 0.01 * filled;
  EXPECT_EQ(result["warnings"].dump().find("left with it") != std::string::npos, is_much);
  EXPECT_LT(memory.mass_carried / static_cast<double>(memory.num_carried),
            filled / static_cast<double>(run.rig->state().num_filled));
}

// Nothing may drive the grains of a heap at rest. Those with one contact keep the twist that the
// collapse left them, here up to 109 rad/s, a free fall over a diameter gives 280 rad/s. Without
// the projection in (R2) single grains gain hundreds of rad/s in this time.
TEST(LiftedTube, NoGrainOfACohesiveHeapAtRestSpinsUp) {
  Case c = Coarse(0.5, 0.4);
  c.models.adhesion = engine::Adhesion::kJkr;
  c.powder.material.surface_energy = 0.02;
  const Outcome run = RunToTheEnd(c);
  ASSERT_EQ(run.EndOf("coming to rest"), PhaseEnd::kAtRest);
  engine::Simulation later = engine::Simulation::Restore(run.rig->simulation().Checkpoint());
  later.Advance(std::llround(0.1 / later.time_step()));
  for (const engine::Particle& p : GrainsOfHeap(later)) {
    EXPECT_LT(base::Norm(p.angular_velocity), 150) << p.id;
  }
}

Case Poured(double sliding_friction, double rolling_friction) {
  Case c = Coarse(sliding_friction, rolling_friction);
  c.filling.kind = FillingKind::kPour;
  return c;
}

TEST(PouredHeap, ItsGrainsAreAllThereAndItsBedIsMeasured) {
  const Outcome dense = RunToTheEnd(Coarse(0.5, 0.2));
  const Outcome poured = RunToTheEnd(Poured(0.5, 0.2));
  EXPECT_EQ(poured.EndOf("pouring"), PhaseEnd::kPoured);
  EXPECT_EQ(poured.EndOf("settling"), PhaseEnd::kAtRest);
  EXPECT_EQ(poured.rig->state().num_filled, dense.rig->state().num_filled);
  for (const Outcome* outcome : {&dense, &poured}) {
    // Grains a tenth of the tube's diameter pack at 0.45 to 0.58 in it.
    EXPECT_GT(outcome->rig->state().bed.solid_fraction, 0.42);
    EXPECT_LT(outcome->rig->state().bed.solid_fraction, 0.60);
    EXPECT_GT(outcome->rig->state().bed.coordination, 2.5);
    EXPECT_LT(outcome->rig->state().bed.coordination, 6);
  }
}

TEST(PouredHeap, AGrainThatFellOutIsNotOfTheBed) {
  engine::Scene scene = SceneOf(Coarse(0.5, 0.2));
  const engine::Vessel vessel{.area = 1e-4, .floor = 0};
  const engine::Bed whole = engine::MeasureBed(engine::Simulation(scene), vessel);
  engine::Particle lost = scene.particles.front();
  lost.id = static_cast<std::int64_t>(scene.particles.size());
  lost.position = {0.02, 0, -0.1};
  scene.particles.push_back(lost);
  const engine::Bed bed = engine::MeasureBed(engine::Simulation(scene), vessel);
  EXPECT_EQ(bed.height, whole.height);
  EXPECT_EQ(bed.solid_fraction, whole.solid_fraction);
}

// What the powder weighs over what it fills; a bed of a tenth of the tube's width packs loosely.
TEST(LiftedTube, TheBulkDensityIsThatOfTheBedBeforeTheLift) {
  const Outcome run = RunToTheEnd(Coarse(0.5, 0.2));
  const auto result = nlohmann::json::parse(run.rig->ResultText(run.heap, {}));
  const double area = std::numbers::pi / 4 * 0.01 * 0.01;
  const double volume = area * result["bed"]["height_m"].get<double>();
  EXPECT_NEAR(result["observables"]["bulk_density_kg_per_m3"].get<double>(), 0.2e-3 / volume,
              0.01 * 0.2e-3 / volume);  // a whole number of grains
}

TEST(LiftedTube, AFunnelThatWouldPourForHoursIsRefused) {
  Case c = Poured(0.5, 0.2);
  c.filling.rate = 3e-11;
  base::Problems problems;
  ValidateCase(c, problems);
  ASSERT_EQ(problems.list().size(), 1);
  EXPECT_EQ(problems.list().front().path, "filling.rate");
  EXPECT_THAT(problems.list().front().message, ::testing::HasSubstr("raise it to"));
}

// Nobody has given a rate: the mass has another unit, or the mouth is too narrow for it.
TEST(LiftedTube, AMassThatWouldRunForHoursIsNamedByItself) {
  Case c = Poured(0.5, 0.2);
  c.filling.mouth_diameter = 2.1 * LargestDiameter(c);
  c.powder.mass *= 250;
  base::Problems problems;
  ValidateCase(c, problems);
  EXPECT_THAT(problems.Text(), ::testing::HasSubstr("powder.mass: is 0."));
  EXPECT_THAT(problems.Text(),
              ::testing::HasSubstr(" g\" if it is in grams, or give a filling.rate"));
}

// The floor does not stop hard grains. Their bed leapt out of its tube, and a heap of nothing was
// called done; thousands of taps went on for hours.
// Where things fall more slowly a tap takes longer; a tap from 3 mm takes 0.18 s on the moon.
TEST(LiftedTube, TapsTakeTheirTimeInTheCasesGravity) {
  Case c = Poured(0.5, 0.2);
  c.filling.taps = TapRule{.count = 2, .height = 3e-3, .interval = 0.12};
  const auto problems_of = [](const Case& checked) {
    base::Problems problems;
    ValidateCase(checked, problems);
    return problems.empty() ? "" : problems.Text();
  };
  EXPECT_EQ(problems_of(c), "");
  c.gravity = 1.62;
  EXPECT_THAT(problems_of(c), ::testing::HasSubstr("taps.interval"));
  c.filling.taps->interval = 0.19;
  EXPECT_EQ(problems_of(c), "");
}

TEST(LiftedTube, TapsThatNoDeviceMakesAreRefused) {
  Case c = Poured(0.5, 0.2);
  c.filling = {};
  c.powder.material.youngs_modulus = 1e9;
  const auto path_with = [&](const TapRule& taps) {
    c.filling.taps = taps;
    base::Problems problems;
    ValidateCase(c, problems);
    return problems.empty() ? "" : problems.list().front().path;
  };
  EXPECT_EQ(path_with({.count = 2, .height = 14e-3, .interval = 0.3}), "");
  EXPECT_EQ(path_with({.count = 2, .height = 1, .interval = 1.5}), "filling.taps.height");
  EXPECT_EQ(path_with({.count = 100000, .height = 3e-3, .interval = 0.1}), "filling.taps.count");
}

TEST(PouredHeap, TapsMakeTheBedDenser) {
  Case c = Poured(0.5, 0.2);
  c.filling.taps = TapRule{.count = 5, .height = 1e-3, .interval = 0.08};
  const Outcome tapped = RunToTheEnd(c);
  const Outcome poured = RunToTheEnd(Poured(0.5, 0.2));
  EXPECT_EQ(tapped.EndOf("tapping"), PhaseEnd::kTapped);
  EXPECT_GT(tapped.rig->state().bed.solid_fraction, poured.rig->state().bed.solid_fraction + 0.005);
}

TEST(PouredHeap, ARestartWhilePouringGoesOnWithTheSameBits) {
  const Case c = Poured(0.5, 0.2);
  const auto whole = MakeRig(c);
  const auto first = MakeRig(c);
  for (int k = 0; k < 8; ++k) first->Advance();
  ASSERT_EQ(first->phase_name(), "pouring");
  ASSERT_GT(first->simulation().num_particles(), 0);
  const auto second = RestoreRig(c, first->StateLine(),
                                 engine::Simulation::Restore(first->simulation().Checkpoint()));
  while (second->phase_name() != "lifting") second->Advance();
  while (whole->phase_name() != "lifting") whole->Advance();
  EXPECT_EQ(whole->StateLine(), second->StateLine());
  EXPECT_TRUE(whole->simulation().Checkpoint() == second->simulation().Checkpoint());
}

// (δ/R)^(5/2) = (5π/4) ρ v²/E* on a wall.
TEST(PouredHeap, SoftGrainsFromAHeightAreRefusedWithWhatHolds) {
  const auto problems_of = [](const Case& c) {
    base::Problems problems;
    ValidateCase(c, problems);
    std::string text;
    for (const base::Problem& p : problems.list()) text += p.path + ": " + p.message + "\n";
    return text;
  };
  Case c = Poured(0.5, 0.2);
  c.filling.drop_height = 67e-3;
  EXPECT_EQ(problems_of(c), "");
  c.powder.material.youngs_modulus = 2e4;
  EXPECT_GT(ImpactShare(c, LiftedTubeRig::VesselOf(c)), kMaxImpactShare);
  EXPECT_NE(problems_of(c).find("filling.drop_height: lets grains sink"), std::string::npos);
  const double share = ImpactShare(c, LiftedTubeRig::VesselOf(c));
  c.powder.material.youngs_modulus *= 32;
  EXPECT_NEAR(ImpactShare(c, LiftedTubeRig::VesselOf(c)) / share, 0.25, 1e-6);
  c.filling.mouth_diameter = 10e-3;
  EXPECT_NE(problems_of(c).find("must be below device.tube_inner_diameter"), std::string::npos);
  c.filling.kind = FillingKind::kDense;
  base::Problems problems;
  c.filling.Validate(problems);
  EXPECT_FALSE(problems.empty());  // a drop height belongs to pouring
}

}  // namespace lifted_tube_test
}  // namespace talus::rigs
