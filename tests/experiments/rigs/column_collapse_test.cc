#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "experiments/rigs/phased/surface.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace column_collapse_test {

Case Collapse(double mass) {
  Case c = CaseOf(RigKind::kColumnCollapse, 0.5, 0.1, mass);
  c.rig.column_collapse = {.length = 0.012, .width = 0.005};
  return c;
}

// Two-dimensional columns run out by ΔL/L = 1.2 a up to an aspect ratio a of about 2, and by
// 1.9 a^(2/3) beyond [lube2005]; by a up to 3 [lajeunesse2005]. A channel five grains wide and
// grains that resist rolling take part of it away: 0.82, 0.90 and 0.91 of Lube's over 36 runs each,
// which scatter by 0.14, 0.07 and 0.05: the means of 8, 3 and 1 scatter by 0.05.
TEST(ColumnCollapse, RunoutGrowsWithTheAspectRatioAsPublished) {
  double before = 0;
  for (const auto& [mass, num_runs] : {std::pair{0.45e-3, 8u}, {0.9e-3, 3u}, {1.8e-3, 1u}}) {
    double runout = 0;
    double share = 0;
    for (unsigned seed = 1; seed <= num_runs; ++seed) {
      Case c = Collapse(mass);
      c.seed = seed;
      const auto rig = Ran(c);
      const double aspect = Value(c, *rig, "aspect_ratio");
      const double one = Value(c, *rig, "runout_m") / 0.012;
      const double published = aspect < 2 ? 1.2 * aspect : 1.9 * std::pow(aspect, 2.0 / 3);
      runout += one / num_runs;
      share += one / published / num_runs;
    }
    EXPECT_GT(share, 0.65);
    EXPECT_LT(share, 1.1);
    EXPECT_GT(runout, before);
    before = runout;
  }
}

// Grains of 1 mm from x = 0 on a floor 5 mm wide: four a strip to 8 mm, one at 8.5 and at 20 mm.
// Powder behind the gate, which never moves, does not count: 99 % of all of it lay behind a front
// that was the nearer the longer the column.
TEST(ColumnCollapse, TheFrontIsWhereTheLayerEnds) {
  std::vector<engine::Particle> grains;
  const auto add = [&](double x) {
    engine::Particle grain;
    grain.position = {x, 0, 0.5e-3};
    grain.radius = 0.5e-3;
    grains.push_back(grain);
  };
  for (int i = 0; i < 32; ++i) add(0.25e-3 * i + 1e-4);
  const double edge = grains.back().position.x + 0.5e-3;
  add(8.5e-3);
  add(20e-3);
  EXPECT_DOUBLE_EQ(EndOfLayer(grains, 0, 5e-3, 1e-3), edge);
  for (int i = 0; i < 5000; ++i) add(-1e-3);
  EXPECT_DOUBLE_EQ(EndOfLayer(grains, 0, 5e-3, 1e-3), edge);
  EXPECT_EQ(EndOfLayer(grains, 10e-3, 5e-3, 1e-3), 10e-3);
  EXPECT_EQ(EndOfLayer({}, 1e-3, 5e-3, 1e-3), 1e-3);
}

// Grains of hardly any friction lie a few to a strip, far away: a front at the gate, or at the
// first gap behind it, made the longest runouts the shortest. A column that stands has lost single
// grains only, however far they have rolled.
TEST(ColumnCollapse, WhatLiesBeyondItsLayerIsLessThanALayer) {
  std::vector<engine::Particle> grains;
  const auto add = [&](int count, double x) {
    engine::Particle grain;
    grain.position.x = x;
    grain.radius = 0.5e-3;
    grains.insert(grains.end(), static_cast<std::size_t>(count), grain);
  };
  add(40, -5e-3);
  add(30, 2e-3);
  add(12, 8e-3);
  EXPECT_FALSE(IsLessThanALayer(grains, {.begin = 0, .end = 5e-3}, 1));
  add(19, 80e-3);
  EXPECT_TRUE(IsLessThanALayer(grains, {.begin = 0, .end = 5e-3}, 1));
  EXPECT_FALSE(IsLessThanALayer(grains, {.begin = 0, .end = 10e-3}, 1));
  add(30, -5e-3);
  EXPECT_FALSE(IsLessThanALayer(grains, {.begin = 0, .end = 0}, 1));
  EXPECT_FALSE(IsLessThanALayer({}, {.begin = 0, .end = 0}, 1));
  add(200, -20e-3);  // a long column, of which only the face can leave
  EXPECT_FALSE(IsLessThanALayer(grains, {.begin = 0, .end = 5e-3}, 1));
  EXPECT_TRUE(IsLessThanALayer(grains, {.begin = 0, .end = 5e-3}, 0.2));
}

// All of it lay far from the gate, and was said to stand.
TEST(ColumnCollapse, WhatHasRunAwayDoesNotStand) {
  Case c = CaseOf(RigKind::kColumnCollapse, 0, 0, 0.1e-3);
  c.powder.material.youngs_modulus = 1e5;
  c.rig.column_collapse = {.length = 0.006, .width = 0.005};
  c.rules.heap.max_time = 0.5;
  const auto rig = Ran(c);
  const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
  for (const char* name : {"runout_m", "angle_deg"}) {
    EXPECT_EQ(result["undefined"][name], "it ran out to less than a layer") << name;
  }
  EXPECT_EQ(result["warnings"].dump().find("stands"), std::string::npos);
  EXPECT_NE(result["warnings"].dump().find("less than a layer"), std::string::npos);
}

// The face of a column five grains high, 12 and 36 mm long, runs out about as far: single ones
// scatter by a sixth, with the slope of some ten grains. A long one had no angle.
TEST(ColumnCollapse, ALongColumnRunsOutAsFarAsItsFace) {
  Case c = Collapse(0.45e-3);
  const double near = Value(c, *Ran(c), "runout_m");
  c.powder.mass *= 3;
  c.rig.column_collapse.length *= 3;
  const auto rig = Ran(c);
  EXPECT_GT(Value(c, *rig, "runout_m"), near / 2);
  EXPECT_LT(Value(c, *rig, "runout_m"), near * 2);
  EXPECT_GT(Value(c, *rig, "angle_deg"), 5);
  EXPECT_LT(Value(c, *rig, "angle_deg"), 50);
}

// A column rests until its gate is out of its way: it has not run out before. By a slow gate it
// runs out from below, and about as far.
TEST(ColumnCollapse, ASlowGateIsWaitedFor) {
  Case c = Collapse(0.45e-3);
  const double at_once = Value(c, *Ran(c), "runout_m");
  c.rig.column_collapse.gate_velocity = 0.05;
  const auto rig = Ran(c);
  EXPECT_NEAR(Value(c, *rig, "runout_m"), at_once, 0.3 * at_once);
  const PhaseRecord& running = rig->RecordOf("running out");
  EXPECT_GT((running.end_time - running.start_time) * 0.05, Value(c, *rig, "height_m"));
  // Grains that stick to the gate go with it: they rode on it for ever.
  c.models.adhesion = engine::Adhesion::kJkr;
  c.powder.material.surface_energy = 0.02;
  const auto sticky = Ran(c);
  EXPECT_EQ(sticky->RecordOf("running out").reason, PhaseEnd::kAtRest);
  EXPECT_LT(Value(c, *sticky, "height_m"), 0.02);
  for (const engine::Particle& p : sticky->simulation().Particles()) EXPECT_LT(p.position.z, 0.02);
}

// The place of the front's centres is a radius short of the gate: no negative runout.
TEST(ColumnCollapse, AColumnThatStandsHasRunOutByNothingAndHasNoAngle) {
  Case c = Collapse(0.45e-3);
  c.models.adhesion = engine::Adhesion::kDmt;
  c.powder.material.surface_energy = 0.5;
  const auto rig = Ran(c);
  EXPECT_EQ(Value(c, *rig, "runout_m"), 0);
  const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
  EXPECT_EQ(result["undefined"]["angle_deg"], "the column stands");
}

// From the top that stands to the front, without a fifth at either end.
TEST(ColumnCollapse, TheAngleIsThatOfTheMiddleOfTheSlope) {
  const Case c = Collapse(0.9e-3);
  const auto rig = Ran(c);
  const std::vector<engine::Particle> grains = rig->Grains();
  const double front = 0.006 + Value(c, *rig, "runout_m");
  double stands = -0.006;
  for (const SurfacePoint& p : SurfaceOf(grains, {.from = -0.006, .to = front, .width = 1e-3})) {
    if (p.top > 0.9 * Value(c, *rig, "column_height_m")) stands = p.x;
  }
  const double reach = front - stands;
  const auto surface =
      SurfaceOf(grains, {.from = stands + 0.2 * reach, .to = stands + 0.8 * reach, .width = 1e-3});
  const double slope = std::abs(SlopeOf(surface).value());
  EXPECT_NEAR(Value(c, *rig, "angle_deg"), SlopeAngle(slope), 0.5);
}

}  // namespace column_collapse_test
}  // namespace talus::rigs
