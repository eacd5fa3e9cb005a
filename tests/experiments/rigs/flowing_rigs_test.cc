// Powder that flows out of an orifice, a slot or a funnel, against what is known of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/vessel.h"
#include "experiments/rigs/phased/flow.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/rig_run.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace flowing_rigs_test {

using ::testing::HasSubstr;

Case Orifice(double diameter, double mass) {
  Case c = CaseOf(RigKind::kOrificeFlow, 0.5, 0.05, mass);
  c.rig.orifice_flow = {.diameter = 0.016, .orifice = diameter, .arch_time = 0.1};
  c.materials.walls = WallMaterial{.sliding_friction = 0};
  return c;
}

double DischargeRate(const Case& c) {
  const auto rig = Ran(c);
  EXPECT_EQ(Value(c, *rig, "flows"), 1);
  return Value(c, *rig, "discharge_rate_kg_per_s");
}

// That of the orifice of 10 mm, with which others are compared; run once for all of them.
double WideRate() {
  static const double kRate = DischargeRate(Orifice(0.010, 4e-3));
  return kRate;
}

// C ρ_b √g (D - k d)^2.5 [beverloo1961]. C goes with powder and cone, so that of one orifice gives
// the other's rate, within a tenth, which is what the law is trusted with.
const double kBeverlooRatio = std::pow((0.010 - 1.5e-3) / (0.0075 - 1.5e-3), 2.5);

TEST(OrificeFlow, TheRateFollowsBeverlooFromOrificeToOrifice) {
  const double ratio = WideRate() / DischargeRate(Orifice(0.0075, 4e-3));
  EXPECT_NEAR(ratio, kBeverlooRatio, 0.1 * kBeverlooRatio);
}

// The cone of Hall's and Carney's funnels. Its smooth sides lead the powder to the orifice.
TEST(OrificeFlow, TheRateFollowsBeverlooOutOfACone) {
  const auto rate = [](double orifice) {
    Case c = Orifice(orifice, 4e-3);
    c.rig.orifice_flow.cone_angle = std::numbers::pi / 3;
    return DischargeRate(c);
  };
  const double large = rate(0.010);
  EXPECT_NEAR(large / rate(0.0075), kBeverlooRatio, 0.1 * kBeverlooRatio);
  EXPECT_GT(large, WideRate());
}

TEST(OrificeFlow, AnArchIsAnAnswer) {
  const Case c = Orifice(0.002, 0.5e-3);
  const auto rig = Ran(c);
  EXPECT_EQ(Value(c, *rig, "flows"), 0);
  EXPECT_EQ(Value(c, *rig, "discharge_rate_kg_per_s"), 0);
  const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
  EXPECT_THAT(std::string(result["undefined"]["discharge_time_s"]), HasSubstr("an arch"));
}

// A heap that the plate's rim cuts off has the angle of repose; smooth grains leave a layer of
// single ones, which has none.
TEST(FunnelHeap, RoughGrainsStandSmoothOnesDoNotAndEveryGrainIsWeighed) {
  std::vector<double> indices;
  for (const double friction : {0.1, 0.6}) {
    Case c = CaseOf(RigKind::kFunnelHeap, friction, friction / 2, 0.8e-3);
    c.rig.funnel_heap = {.plate_diameter = 0.014, .height = 0.012, .outlet = 0.005};
    c.filling.kind = FillingKind::kPour;
    const auto rig = Ran(c);
    const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
    EXPECT_EQ(result["observables"].contains("angle_of_repose_triangle_deg"), friction > 0.1);
    if (friction > 0.1) {
      EXPECT_GT(Value(c, *rig, "angle_of_repose_triangle_deg"), 25);
      EXPECT_LT(Value(c, *rig, "angle_of_repose_triangle_deg"), 45);
    }
    const double weighed = Value(c, *rig, "mass_on_plate_kg") + Value(c, *rig, "mass_fallen_kg");
    EXPECT_NEAR(weighed, 0.8e-3, 2e-6);  // to a whole number of grains
    indices.push_back(Value(c, *rig, "heap_cohesive_index"));
  }
  // A cone, nearly.
  EXPECT_LT(indices[1], 0.5);
  EXPECT_GT(indices[0], indices[1]);
}

// The same powder on the same plate, with more of it than stays: grains that fall from a funnel
// leave a flatter heap than those that a tube as wide as the plate sets down, 38.5 degrees and 40.0
// (a funnel that follows) for 45.8 with this seed; single heaps of so few grains scatter by some
// two. A funnel that follows starts lower than the heap is high in the end, where one that stands
// still would be buried; over ten seeds it ends 2.1 ± 0.5 mm higher than the heap, whose top it has
// followed up and not down.
TEST(FunnelHeap, ItIsFlatterThanTheLiftedTubesByTenDegreesAtMost) {
  Case tube = CaseOf(RigKind::kLiftedTube, 0.5, 0.2, 1.2e-3);
  tube.rig.lifted_tube.tube_inner_diameter = tube.rig.lifted_tube.plate_diameter = 0.014;
  const double lifted = Value(tube, *Ran(tube), "angle_of_repose_triangle_deg");
  for (const bool follows : {false, true}) {
    Case c = CaseOf(RigKind::kFunnelHeap, 0.5, 0.2, 1.2e-3);
    c.rig.funnel_heap = {.plate_diameter = 0.014,
                         .height = follows ? 0.003 : 0.010,
                         .outlet = 0.005,
                         .follows = follows};
    c.filling.kind = FillingKind::kPour;
    const auto rig = Ran(c);
    const double angle = Value(c, *rig, "angle_of_repose_triangle_deg");
    EXPECT_LT(angle, lifted) << follows;
    EXPECT_GT(angle, lifted - 10) << follows;
    const double top = Value(c, *rig, "height_m");
    if (!follows) continue;
    EXPECT_GT(rig->state().pour.lift, top - 0.001);
    EXPECT_LT(rig->state().pour.lift, top + 0.004);
  }
}

// Grains that fall in a file are none of the heap, and the heap is not at rest before the last of
// them has landed: a single one on its way made heaps ten times as high.
TEST(FunnelHeap, GrainsOnTheirWayAreNoneOfTheHeap) {
  Case c = CaseOf(RigKind::kFunnelHeap, 0.5, 0.2, 0.3e-3);
  c.rig.funnel_heap = {.plate_diameter = 0.014, .height = 0.055, .outlet = 0.005};
  c.filling.kind = FillingKind::kPour;
  c.filling.rate = 0.1e-3;
  const auto rig = Ran(c);
  EXPECT_LT(Value(c, *rig, "height_m"), 0.006);
  EXPECT_GT(rig->RecordOf("settling").end_time - rig->RecordOf("settling").start_time,
            std::sqrt(2 * 0.055 / 9.81));
  EXPECT_NEAR(Value(c, *rig, "mass_on_plate_kg") + Value(c, *rig, "mass_fallen_kg"), 0.3e-3, 2e-6);
}

// What clings to the plate's side and underside is none of the heap either: a balance on the plate
// would weigh it, a picture of the heap does not show it.
TEST(FunnelHeap, WhatClingsToThePlateFromBelowIsNoneOfTheHeap) {
  Case c = CaseOf(RigKind::kFunnelHeap, 0.5, 0.2, 0.5e-3);
  c.rig.funnel_heap = {.plate_diameter = 0.008, .height = 0.012, .outlet = 0.006};
  c.filling.kind = FillingKind::kPour;
  c.models.adhesion = engine::Adhesion::kJkr;
  c.powder.material.surface_energy = 0.05;
  const auto rig = Ran(c);
  bool clings = false;
  for (const engine::Particle& p : rig->simulation().Particles()) clings |= p.position.z < 0;
  EXPECT_TRUE(clings);  // else this tests nothing
  for (const engine::Particle& p : rig->Grains()) EXPECT_GT(p.position.z, 0);
}

// An opening that powder trickles out of has not stopped, however much rests above it.
// [kg/s] of a slot of width D and length W in a box whose bed has this density [beverloo1961,
// brown1970]: C ρ_b √g W (D - k d)^1.5 with C = 1.03, k = 1.4.
double Beverloo(double density, double slot, double width) {
  return 1.03 * density * std::sqrt(9.81) * width * std::pow(slot - 1.4e-3, 1.5);
}

// The constant of the law goes with the powder, 0.55 to 0.65 of a round hole's being common; with
// smooth side walls a band of 0.7 to 1.3. Its ratio for two slots needs no constant.
TEST(DrawDown, TheDischargeFollowsBeverloo) {
  std::vector<double> rates, laws;
  for (const double slot : {0.006, 0.009}) {
    Case c = CaseOf(RigKind::kDrawDown, 0.5, 0.05, 2e-3);
    c.rig.draw_down = {.length = 0.024, .width = 0.005, .slot = slot, .height = 0.02};
    c.materials.walls = WallMaterial{.sliding_friction = 0};
    c.rules.heap.max_time = 0.05;  // while it flows, the cap of coming to rest does not end it
    const auto rig = Ran(c);
    EXPECT_NE(rig->RecordOf("discharging").reason, PhaseEnd::kTimeCap);
    rates.push_back(Value(c, *rig, "discharge_rate_kg_per_s"));
    laws.push_back(Beverloo(0.55 * kDensity, slot, 0.005));
    EXPECT_GT(rates.back(), 0.7 * laws.back());
    EXPECT_LT(rates.back(), 1.3 * laws.back());
    EXPECT_NEAR(Value(c, *rig, "mass_fallen_kg") + Value(c, *rig, "mass_left_kg"), 2e-3, 5e-6);
  }
  EXPECT_NEAR(rates[1] / rates[0], laws[1] / laws[0], 0.25 * laws[1] / laws[0]);
}

// With this seed a grain that still fell was the heap's top: 48 degrees, of one of 33. And what
// has not flowed has no slopes.
TEST(DrawDown, AGrainInTheAirIsNoSlope) {
  Case c = CaseOf(RigKind::kDrawDown, 0.5, 0.2, 2e-3);
  c.rig.draw_down = {.length = 0.024, .width = 0.005, .slot = 0.009, .height = 0.02};
  c.powder.sizes.min = base::ParseQuantity("0.9 mm", base::Dimension::kLength);  // to the bit
  c.powder.sizes.max = base::ParseQuantity("1.1 mm", base::Dimension::kLength);
  c.seed = 2;
  const auto rig = Ran(c);
  EXPECT_NEAR(Value(c, *rig, "angle_deg"), 33, 4);
  c.rig.draw_down.slot = 0.0023;
  const auto jammed = Ran(c);
  const auto result = nlohmann::json::parse(jammed->ResultText(jammed->Grains(), {}));
  for (const char* angle : {"angle_deg", "shear_angle_deg"}) {
    EXPECT_EQ(result["undefined"][angle], "less than a tenth ran through the slot") << angle;
  }
}

// In a longer box the top beyond the face stays level: the slope of both together went with the
// box's length (42, 31 and 15 degrees of boxes of 24, 48 and 72 mm). Faces of one powder in two
// boxes differ by what some eight strips of single grains scatter.
TEST(DrawDown, TheFaceAboveTheSlotIsAsSteepInALongerBox) {
  Case c = CaseOf(RigKind::kDrawDown, 0.5, 0.2, 2e-3);
  c.rig.draw_down = {.length = 0.024, .width = 0.005, .slot = 0.009, .height = 0.02};
  const auto filled = Ran(c);
  c.rig.draw_down.length = 0.048;
  c.powder.mass = 4e-3;  // as high
  const auto longer = Ran(c);
  EXPECT_NEAR(Value(c, *longer, "shear_angle_deg"), Value(c, *filled, "shear_angle_deg"), 8);
}

// Grains at the underside of a shelf were the top of the heap below it, and had fallen.
TEST(DrawDown, WhatClingsToTheShelvesHasNotFallen) {
  Case c = CaseOf(RigKind::kDrawDown, 0.5, 0.05, 2e-3);
  c.rig.draw_down = {.length = 0.024, .width = 0.005, .slot = 0.009, .height = 0.02};
  c.models.adhesion = engine::Adhesion::kJkr;
  c.powder.material.surface_energy = 0.05;
  const auto rig = Ran(c);
  const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
  const double fallen = result["observables"]["mass_fallen_kg"];
  double in_lower_half = 0, elsewhere = 0, at_underside = 0;
  for (const engine::Particle& p : rig->simulation().Particles()) {
    if (p.position.z >= 0.02) continue;
    const double mass = kDensity * 4 / 3 * std::numbers::pi * std::pow(p.radius, 3);
    const bool touches = p.position.z > 0.02 - 1.1 * p.radius;
    (touches ? at_underside : p.position.z < 0.01 ? in_lower_half : elsewhere) += mass;
  }
  EXPECT_GT(at_underside, 0);
  EXPECT_GE(fallen, in_lower_half - 1e-9);
  EXPECT_LE(fallen, in_lower_half + elsewhere + 1e-9);  // some of what is there hangs on by others
}

// Eight grains that fell through a slot before it jammed had a rate of their own.
TEST(Flow, WhatJamsHasTheRateZeroAndNoTime) {
  const std::vector<Passed> flow{{0, 0}, {0.01, 0.3}, {0.02, 0.6}, {0.03, 0.9}, {0.04, 1}};
  const auto jammed = FlowReadings(flow, 1, HasFlowed(1, 10.1), "it jams");
  EXPECT_EQ(jammed[0].undefined, "it jams");
  EXPECT_EQ(jammed[1].value, 0);
  const auto flowing = FlowReadings(flow, 1, HasFlowed(1, 9.9), "it jams");
  EXPECT_NEAR(flowing[1].value, 30, 1e-9);
  EXPECT_NEAR(flowing[0].value, 0.035, 1e-9);
}

TEST(Flow, HasStoppedWhenNothingHasPassedForLongEnough) {
  const std::vector<Passed> flow{{0, 0}, {0.1, 1}, {0.2, 2}, {0.3, 2}, {0.4, 2}};
  EXPECT_TRUE(HasStopped(flow, 0.2));
  EXPECT_FALSE(HasStopped(flow, 0.25));
  EXPECT_FALSE(HasStopped(std::span(flow).first(3), 0.05));
  EXPECT_FALSE(HasStopped({}, 0.1));
}

// The rim keeps a layer on the plate for the heap to stand on: more stays, as much as fits below
// the rim at least by half. A photograph shows rim and plate as one body, so that the heap's height
// and angles are those above the rim; from the plate up the triangle's had 14 degrees more.
TEST(FunnelHeap, ARimKeepsALayerThatTheHeapStandsOn) {
  constexpr double kRim = 0.002;
  std::vector<double> masses, heights, angles;
  for (const double rim : {0.0, kRim}) {
    Case c = CaseOf(RigKind::kFunnelHeap, 0.5, 0.2, 1.2e-3);
    c.rig.funnel_heap = {
        .plate_diameter = 0.014, .rim_height = rim, .height = 0.014, .outlet = 0.005};
    c.filling.kind = FillingKind::kPour;
    const auto rig = Ran(c);
    masses.push_back(Value(c, *rig, "mass_on_plate_kg"));
    heights.push_back(Value(c, *rig, "height_m"));
    angles.push_back(Value(c, *rig, "angle_of_repose_triangle_deg"));
  }
  const double layer = std::numbers::pi / 4 * 0.014 * 0.014 * kRim * 0.55 * kDensity;
  EXPECT_GT(masses[1] - masses[0], layer / 2);
  EXPECT_LT(masses[1] - masses[0], 1.5 * layer);
  EXPECT_NEAR(heights[1], heights[0], kRim / 2);
  EXPECT_NEAR(angles[1], angles[0], 5);  // single heaps scatter by some two degrees
}

// It starts and ends slower: the rate is that from a fifth to three fifths of what passes.
TEST(Flow, TheRateIsThatOfItsMiddle) {
  const std::vector<Passed> flow{{0, 0}, {0.1, 0.2}, {0.15, 0.6}, {0.35, 1}};
  const auto readings = FlowReadings(flow, 1, true, "it jams");
  EXPECT_NEAR(readings[1].value, 0.4 / 0.05, 1e-9);
  EXPECT_NEAR(readings[0].value, 0.15 + 0.2 * 0.35 / 0.4, 1e-9);
}

// A bed three grains deep on a wide flat floor: less than a tenth of it runs out, and leaves an
// open crater. It was called an arch, with a rate of 0.
TEST(OrificeFlow, ACraterIsNoArch) {
  Case c = CaseOf(RigKind::kOrificeFlow, 0.5, 0.1, 3.7e-3);
  c.rig.orifice_flow = {.diameter = 0.034, .orifice = 0.006, .arch_time = 0.2};
  const auto rig = Ran(c);
  EXPECT_LT(Value(c, *rig, "mass_fallen_kg"), 0.1 * 3.7e-3);
  EXPECT_EQ(Value(c, *rig, "flows"), 1);
  EXPECT_GT(Value(c, *rig, "discharge_rate_kg_per_s"), 0);
}

// The first grain lies on the floor at the edge, and holds the second below it, with nothing under
// that; the third falls. The second had fallen, with no grain gone and an arch above it.
TEST(OrificeFlow, WhatHangsUnderTheOrificeHasNotFallen) {
  const Case c = Orifice(0.005, 0.1e-3);
  constexpr double kRadius = 0.5e-3;
  const auto grain = [](std::int64_t id, double x, double z) {
    return engine::Particle{.id = id, .radius = kRadius, .position = {x, 0, z}};
  };
  const double leg = 1.999 * kRadius / std::numbers::sqrt2;
  const engine::Particle edge = grain(0, 0.0025 + 0.3 * kRadius, 0.999 * kRadius);
  FilledScene made = FillVessel(c, EntryOf(c).vessel(c));
  made.scene.particles = {edge, grain(1, edge.position.x - leg, edge.position.z - leg),
                          grain(2, 0, -4e-3)};
  made.scene.walls = EntryOf(c).walls(c, 0.01);
  made.scene.walls[kGate].shape = engine::Disc{.center = {0, 0, -1}, .radius = 1e-3};  // away
  engine::Simulation simulation(made.scene);
  simulation.RemoveWall(kGate);
  const auto rig = RestoreRig(c, MakeRig(c)->StateLine(), std::move(simulation));
  const double mass = kDensity * 4 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  EXPECT_NEAR(Value(c, *rig, "mass_fallen_kg"), mass, 1e-9 * mass);
}

TEST(OrificeFlow, AnArchIsLookedAtForItsTime) {
  Case c = CaseOf(RigKind::kOrificeFlow, 0.5, 0.05, 0.5e-3);
  c.rig.orifice_flow = {.diameter = 0.016, .orifice = 0.002, .arch_time = 0.3};
  c.materials.walls = WallMaterial{.sliding_friction = 0};
  const auto rig = Ran(c);
  const PhaseRecord& discharging = rig->RecordOf("discharging");
  EXPECT_EQ(discharging.reason, PhaseEnd::kAtRest);
  EXPECT_GE(discharging.end_time - discharging.start_time, 0.3);
}

}  // namespace flowing_rigs_test
}  // namespace talus::rigs
