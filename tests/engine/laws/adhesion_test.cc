// Spheres that stick.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/engine/claim.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace adhesion_test {

constexpr double kRadius = 50e-6;
constexpr double kPullOff = 1.256637e-7;  // 2π γ* R*, γ* = 4e-4 J/m² [N]

Material Sticky() {
  return {.density = 2600,
          .youngs_modulus = 1e4,
          .poisson_ratio = 0.3,
          .restitution = 0.9,
          .sliding_friction = 0.5,
          .rolling_friction = 0,
          .surface_energy = 2e-4};
}

Scene OnWall(Adhesion adhesion, double gap) {
  Scene scene = testing::EmptySpace(Sticky());
  scene.models.adhesion = adhesion;
  scene.walls = {testing::Floor()};
  scene.particles = {{.radius = kRadius, .position = {0, 0, kRadius + gap}}};
  return scene;
}

// 1e-5 is what six digits of the known answer are good for; the oscillation has decayed below it.
TEST(DmtContact, RestsWhereElasticForceBalancesThePull) {
  Simulation simulation(OnWall(Adhesion::kDmt, -1e-6));
  simulation.Advance(40000);
  const auto contacts = simulation.Contacts();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].second, -1);
  testing::Formula("(4/3) Y* √R* δ^1.5 = 2πγ*R*");
  testing::Verify({"overlap", contacts[0].overlap, 1.80539e-6, 1e-5});
  EXPECT_NEAR(base::Norm(contacts[0].force) / kPullOff, 0, 1e-5);
}

TEST(DmtContact, PullReachesAcrossTheGapAndNoFarther) {
  Scene scene = OnWall(Adhesion::kDmt, 0);
  const double reach =
      MakePairConstants(scene.materials[0], scene.materials[0], scene.models).adhesion_gap;
  for (const double share : {0.3, 0.9, 1.1}) {
    scene.particles[0].position.z = kRadius + share * reach;
    Simulation simulation(scene);
    simulation.Advance(2000);
    EXPECT_EQ(simulation.Contacts().size(), share < 1 ? 1u : 0u) << share;
  }
}

// Its range grows as γ^(-1/2): a search near its lower bound listed every pair of a heap.
TEST(DmtContact, WhatHoldsNothingReachesNowhere) {
  Material material = testing::Glass();
  const ContactModels models{.adhesion = Adhesion::kDmt};
  for (const double surface_energy : {1e-6, 2e-10, 1e-11, 1e-15}) {
    material.surface_energy = surface_energy;
    const PairConstants pair = MakePairConstants(material, material, models);
    EXPECT_EQ(pair.pull_off > 0, surface_energy > 1e-10) << surface_energy;
    EXPECT_LT(pair.adhesion_gap, 1e-4) << surface_energy;
  }
}

// Hangs from a ceiling under a load that grows by 1 % of what is expected at a time: the first that
// it does not bear [N]. A step overshoots by as much at most.
double PullOff(Adhesion adhesion, double expected) {
  Scene scene = OnWall(adhesion, -1.8e-6);
  const double mass = SphereMass(scene.materials[0], kRadius);
  scene.materials[0].restitution = 0.1;  // so that the load, put on at once, does not swing
  Simulation settled(scene);
  settled.Advance(40000);
  scene.particles = settled.Particles();
  scene.particles[0].velocity = {};
  double load = 0;
  for (int step = 1; step <= 110; ++step) {
    load = expected * step / 100;
    scene.gravity = {0, 0, load / mass};
    Simulation simulation(scene);
    simulation.Advance(4000);
    if (simulation.Contacts().empty()) break;
    scene.particles = simulation.Particles();
    scene.particles[0].velocity = {};
  }
  return load;
}

TEST(DmtContact, SeparatesAtThePullOffForce) {
  testing::Formula("2πγ*R*, 4πγR* of equal spheres");
  testing::Verify({"pull-off", PullOff(Adhesion::kDmt, kPullOff), kPullOff, 0.02});
}

// The simplified law ends at δ = 0, at -(4/3)πγ*R*, two thirds of the DMT pull-off.
TEST(JkrContact, SeparatesAtThePullOffForceOfItsLastContact) {
  const double expected = 2.0 / 3 * kPullOff;
  testing::Formula("(4/3)πγ*R* at δ = 0");
  testing::Verify({"pull-off", PullOff(Adhesion::kJkr, expected), expected, 0.02});
}

TEST(JkrContact, RestsAtTheZeroForceContact) {
  Simulation simulation(OnWall(Adhesion::kJkr, -1e-6));
  simulation.Advance(60000);
  const auto contacts = simulation.Contacts();
  ASSERT_EQ(contacts.size(), 1u);
  const double y_star = MakePairConstants(Sticky(), Sticky(), {}).y_star;
  const double b = 2 * std::numbers::pi * 4e-4 * kRadius * kRadius / y_star;
  const double a = std::cbrt(2.25 * b);  // a³ = 9πγ*R*²/(2Y*)
  testing::Formula("δ = (a² − √(2πγ*R*²a/Y*))/R*, a³ = 9πγ*R*²/(2Y*)");
  testing::Verify({"overlap", contacts[0].overlap, (a * a - std::sqrt(b * a)) / kRadius, 1e-5});
}

}  // namespace adhesion_test
}  // namespace talus::engine
