// What a simulation says of its state: energies, contacts, loads, spheres between two steps.
#include <gtest/gtest.h>

#include "tests/engine/scenes.h"

namespace talus::engine {
namespace observe_test {

TEST(Energies, OfOneSphereAreThoseOfItsMotion) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  const double r = 1e-3, mass = SphereMass(scene.materials[0], r);
  scene.particles = {{.radius = r,
                      .position = {0, 0, 0.3},
                      .velocity = {0.3, 0, 0.4},
                      .angular_velocity = {3, 0, 4}}};
  const EnergySums sums = Simulation(scene).Energies();
  EXPECT_NEAR(sums.translational / (0.5 * mass * 0.25), 1, 1e-12);
  EXPECT_NEAR(sums.rotational / (0.5 * 0.4 * mass * r * r * 25), 1, 1e-12);
  EXPECT_NEAR(sums.potential / (mass * 9.81 * 0.3), 1, 1e-12);
}

// The leapfrog keeps velocities half a step off: back at the start, and forward for whoever asks.
// A sphere that slides on the floor would lose 1e-3 of its spin in half a step.
TEST(Particles, AtTheStartHaveTheVelocitiesThatWereGiven) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  scene.walls = {testing::Floor()};
  scene.particles = {{.radius = 1e-3,
                      .position = {0, 0, 1e-3 - 1e-6},
                      .velocity = {0.5, 0, 0},
                      .angular_velocity = {0, 7, 0}}};
  const Particle sphere = Simulation(scene).Particles()[0];
  EXPECT_NEAR(sphere.velocity.x / 0.5, 1, 1e-6);
  EXPECT_NEAR(sphere.angular_velocity.y / 7, 1, 1e-4);
}

TEST(Contacts, TheForceActsOnTheFirstWhateverTheOrderOfTheSpheres) {
  for (const double sign : {1.0, -1.0}) {
    Scene scene = testing::EmptySpace(testing::Glass());
    scene.particles = {{.id = 5, .radius = 1e-3, .position = {sign * 1.99e-3, 0, 0}},
                       {.id = 3, .radius = 1e-3, .position = {0, 0, 0}}};
    const auto contacts = Simulation(scene).Contacts();
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].first, 3);
    EXPECT_EQ(contacts[0].normal.x, sign);
    EXPECT_LT(sign * contacts[0].force.x, 0);  // apart
  }
}

// A sphere slides along x on a disc in z = 0: only its normal force has a lever about the
// disc's centre; at the sphere's own centre friction would have one of 1 mm.
TEST(WallLoads, FrictionActsAtTheSurfaceOfTheWall) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.particles = {{.radius = 1e-3, .position = {0, 0, 1e-3 - 1e-6}, .velocity = {1, 0, 0}}};
  scene.walls = {{.name = "plate", .shape = Disc{.center = {}, .radius = 0.01}}};
  Simulation simulation(scene);
  simulation.Advance(2);
  const WallLoad load = simulation.WallLoads()[0];
  ASSERT_GT(load.force.x, 1e-9);
  EXPECT_NEAR(load.torque.y, -simulation.Particles()[0].position.x * load.force.z,
              1e-6 * 1e-3 * load.force.x);
}

// Pushed off a floor by one overlap, four times the density gives half the speed; the half step at
// the start was that of the light sphere.
TEST(SetMaterial, AnotherDensityIsAnotherMass) {
  const auto speed = [](bool is_changed) {
    Scene scene = testing::EmptySpace(testing::Glass());
    scene.walls = {testing::Floor()};
    scene.time_step = 1e-6;
    scene.particles = {{.radius = 1e-3, .position = {0, 0, 1e-3 - 1e-5}}};
    Material heavy = scene.materials[0];
    heavy.density *= 4;
    if (!is_changed) scene.materials[0] = heavy;
    Simulation simulation(scene);
    if (is_changed) simulation.SetMaterial(0, heavy);
    simulation.Advance(100);
    return simulation.Particles()[0].velocity.z;
  };
  EXPECT_NEAR(speed(true) / speed(false), 1, 0.05);
}

}  // namespace observe_test
}  // namespace talus::engine
