// Walls that a force presses: a lid on a powder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/laws/pressed_bed.h"
#include "tests/engine/scenes.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace press_test {

constexpr double kRadius = 1e-3;  // [m]

Wall Lid(double height) {
  return {.name = "lid", .shape = Disc{.center = {0, 0, height}, .radius = 0.01}};
}

double HeightOf(const Simulation& simulation, int wall) {
  return std::get<Disc>(simulation.Walls()[wall].shape).center.z;
}

// w = F/c (1 − exp(−c t/m)) in free motion, and so x(t).
TEST(Press, AFreeLidTendsToItsSpeedAsTheEquationSays) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.time_step = 1e-6;
  scene.walls = {Lid(1)};
  Simulation simulation(scene);
  const Press press{.walls = {0}, .force = 0.5, .mass = 2e-3, .damping = 4};
  simulation.SetPresses({press});
  simulation.Advance(1000);
  const double t = simulation.time(), tau = press.mass / press.damping;
  const double way = FreeSpeed(press) * (t - tau * (1 - std::exp(-t / tau)));
  // The leapfrog's half step at the start is worth Δt/2 of way.
  EXPECT_NEAR(1 - HeightOf(simulation, 0), way, 1e-3 * way);
  EXPECT_NEAR(simulation.Presses()[0].speed, FreeSpeed(press) * (1 - std::exp(-t / tau)), 1e-3);
}

// One sphere between floor and lid, without weight: (4/3) Y* √R δ^(3/2) = F on either side.
Simulation Squeezed(double force, int num_threads = 1) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.num_threads = num_threads;
  scene.particles = {{.radius = kRadius, .position = {0, 0, kRadius}}};
  scene.walls = {testing::Floor(),
                 Lid(2.1 * kRadius),
                 {.name = "vane",
                  .shape = Rectangle{.center = {5e-3, 0, 2.1 * kRadius},
                                     .normal = {0, 1, 0},
                                     .width = 2e-3,
                                     .height = 1e-3},
                  .motion = {{.time = 0, .velocity = {0.01, 0, 0}}}}};
  Simulation simulation(scene);
  simulation.SetPresses({{.walls = {1, 2}, .force = force, .mass = 1e-4, .damping = 0.3}});
  return simulation;
}

TEST(Press, ALidAtRestCarriesItsForceAndStandsAtTheHertzOverlap) {
  const double force = 0.02;
  Simulation simulation = Squeezed(force);
  simulation.Advance(std::llround(0.1 / simulation.time_step()));
  const Material glass = testing::Glass();
  const double y_star = MakePairConstants(glass, glass, {}).y_star;
  const double overlap = std::pow(force / (4.0 / 3 * y_star * std::sqrt(kRadius)), 2.0 / 3);
  // The kernels' single precision; a force half as large would leave 0.63 of the overlap.
  EXPECT_NEAR(HeightOf(simulation, 1), 2 * kRadius - 2 * overlap, 1e-3 * overlap);
  EXPECT_NEAR(simulation.WallLoads()[1].force.z / force, 1, 1e-4);
  EXPECT_NEAR(simulation.Presses()[0].speed, 0, 1e-8);
  // What is pressed together moves together, beside its own motion.
  const Vec3 vane = std::get<Rectangle>(simulation.Walls()[2].shape).center;
  EXPECT_DOUBLE_EQ(vane.z, HeightOf(simulation, 1));
  EXPECT_NEAR(vane.x, 5e-3 + 0.01 * simulation.time(), 1e-12);
}

TEST(Press, AnInterruptedRunAndMoreThreadsGiveTheSameBits) {
  Simulation whole = Squeezed(0.02);
  whole.Advance(3000);
  Simulation first = Squeezed(0.02, 2);
  first.Advance(1234);
  Simulation second = Simulation::Restore(first.Checkpoint());
  second.Advance(3000 - 1234);
  EXPECT_EQ(HeightOf(second, 1), HeightOf(whole, 1));
  EXPECT_EQ(second.Presses()[0].speed, whole.Presses()[0].speed);
  EXPECT_EQ(second.Particles()[0].position.z, whole.Particles()[0].position.z);
}

TEST(Press, WhatIsPressedNoMoreStands) {
  Simulation simulation = Squeezed(0.02);
  simulation.Advance(100);
  simulation.SetPresses({});
  const double height = HeightOf(simulation, 1);
  simulation.Advance(100);
  EXPECT_EQ(HeightOf(simulation, 1), height);
}

TEST(Press, WhatCannotBeIsNamed) {
  Simulation simulation = Squeezed(0.02);
  const Press good = simulation.Presses()[0];
  const auto error_of = [&](const Press& press) {
    return ErrorIn([&] { simulation.SetPresses({press}); });
  };
  Press bad = good;
  bad.walls = {7};
  EXPECT_THAT(error_of(bad), ::testing::HasSubstr("walls"));
  bad = good;
  bad.mass = 0;
  EXPECT_THAT(error_of(bad), ::testing::HasSubstr("mass"));
  bad = good;
  bad.damping = 0;
  EXPECT_THAT(error_of(bad), ::testing::HasSubstr("damping"));
  bad = good;
  bad.direction = {0, 0, -2};
  EXPECT_THAT(error_of(bad), ::testing::HasSubstr("direction"));
  bad = good;
  bad.force = std::nan("");
  EXPECT_THAT(error_of(bad), ::testing::HasSubstr("force"));
  EXPECT_EQ(error_of(good), "");
}

// Rumpf's σ = φ n F / (π d²) with 0.58 of solid, 4.5 contacts a grain and the pull-off force of
// DMT, F = 2π γ R* with γ* = 2 γ.
TEST(PressedBed, AdhesionPressesAsRumpfSays) {
  Material material = testing::Glass();
  material.surface_energy = 1e-3;
  const double r = 1e-4, pull_off = 2 * std::numbers::pi * 2e-3 * r / 2;
  const PairConstants pair = MakePairConstants(material, material, {.adhesion = Adhesion::kDmt});
  EXPECT_NEAR(AdhesiveStress(pair, r) / (0.58 * 4.5 * pull_off / (std::numbers::pi * 4 * r * r)), 1,
              1e-12);
}

}  // namespace press_test
}  // namespace talus::engine
