// Scenes that make no sense are refused with every problem, and runs that blow up say where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "base/error.h"
#include "tests/engine/cloud.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace bad_input_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ErrorOf(const auto& action) { return ErrorIn<base::Error>(action); }
std::string SceneError(const Scene& scene) {
  return ErrorOf([&] { Simulation simulation(scene); });
}

Scene Sound() {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  scene.walls = {testing::Floor()};
  scene.particles = testing::Cloud({.per_side = 2});
  return scene;
}

TEST(Scene, ReportsEveryProblemAtOnce) {
  Scene scene = Sound();
  EXPECT_EQ(SceneError(scene), "");
  scene.materials[0].poisson_ratio = 0.7;
  scene.materials[0].density = NAN;
  scene.particles[1].radius = -1;
  scene.particles[2].position.x = INFINITY;
  scene.particles[3].id = scene.particles[4].id;
  scene.particles[6].id = -6;
  scene.particles[5].material = 3;
  scene.walls.push_back({.name = "tube",
                         .shape = OpenCylinder{.axis = {0, 0, 0}, .radius = 0, .length = 1},
                         .material = 9});
  scene.walls.push_back({.name = "m", .shape = Plane{}, .motion = {{.time = 1}, {.time = 1}}});
  scene.rayleigh_fraction = 0.5;
  scene.models.adhesion_cutoff = 1;
  EXPECT_THAT(
      SceneError(scene),
      AllOf(HasSubstr("materials[0].poisson_ratio"), HasSubstr("materials[0].density: is nan"),
            HasSubstr("particles[1].radius: is -1"), HasSubstr("particles[2].position"),
            HasSubstr("particles[4].id: is given twice"), HasSubstr("particles[5].material"),
            HasSubstr("particles[6].id: is -6, must not be negative"), HasSubstr("walls[1].shape"),
            HasSubstr("walls[1].shape.radius: is 0"), HasSubstr("walls[1].material")));
  EXPECT_THAT(SceneError(scene),
              AllOf(HasSubstr("walls[2].motion[1].time"), HasSubstr("rayleigh_fraction: is 0.5"),
                    HasSubstr("models.adhesion_cutoff: is 1")));
}

TEST(Scene, OverlappingAndEscapedSpheresAreNamed) {
  Scene scene = Sound();
  scene.particles[3].position = scene.particles[2].position + Vec3{1e-4, 0, 0};
  scene.particles[5].position.z = -1;
  EXPECT_THAT(SceneError(scene),
              AllOf(HasSubstr("particles[3].position: overlaps particles[2] by"),
                    HasSubstr("particles[5].position: stands in the wall \"floor\"")));
}

TEST(Scene, TheStepHasAnUpperLimit) {
  Scene scene = Sound();
  scene.time_step = 1;
  EXPECT_THAT(SceneError(scene), HasSubstr("time_step: is 1, must not exceed 0.4 Rayleigh times"));
  scene.time_step = 0;
  scene.particles[0].velocity = {1e4, 0, 0};
  EXPECT_THAT(SceneError(scene), HasSubstr("particles[0].velocity"));
}

TEST(BlowUp, ASphereThatSinksThroughAWallIsNamed) {
  Scene scene = Sound();
  scene.materials[0].youngs_modulus = 1;  // cannot carry its own weight
  scene.particles = {{.id = 42, .radius = 1e-3, .position = {0, 0, 1e-3}}};
  Simulation simulation(scene);
  EXPECT_THAT(ErrorOf([&] { simulation.Advance(100000); }),
              AllOf(HasSubstr("step "), HasSubstr("sphere 42 goes through the wall \"floor\"")));
}

// An elastic sphere with v² = 4 E* (δ/R)^(5/2) / (5 π ρ) sinks by δ (Hertz) and comes back.
TEST(BlowUp, ASphereMaySinkByAShareOfItsRadius) {
  const auto error_at = [](double depth) {
    Scene scene = Sound();
    engine::Material& soft = scene.materials[0];
    soft.youngs_modulus = 1e5;
    soft.restitution = 1;
    const double e_star = 1e5 / (1 - soft.poisson_ratio * soft.poisson_ratio) / 2;
    const double speed =
        std::sqrt(4 * e_star * std::pow(depth, 2.5) / (5 * std::numbers::pi * soft.density));
    scene.gravity = {};
    scene.rayleigh_fraction = 0.03;
    scene.particles = {
        {.id = 42, .radius = 1e-3, .position = {0, 0, 1.01e-3}, .velocity = {0, 0, -speed}}};
    Simulation simulation(scene);
    const std::string error = ErrorOf([&] { simulation.Advance(20000); });
    if (error.empty()) {
      EXPECT_NEAR(simulation.Particles()[0].velocity.z, speed, 0.01 * speed);
    }
    return error;
  };
  EXPECT_EQ(error_at(0.65), "");
  EXPECT_THAT(error_at(1.3), HasSubstr("sphere 42 goes through the wall \"floor\""));
}

// A wall could pass a sphere between two looks.
TEST(FastWall, IsRefusedInASceneAndLater) {
  Scene scene = Sound();
  Simulation simulation(scene);
  const std::vector<MotionStep> fast{{.time = 0, .velocity = {0, 0, 60}}};
  EXPECT_THAT(ErrorOf([&] { simulation.SetMotion(0, fast); }), HasSubstr("radii of the smallest"));
  scene.walls[0].motion = fast;
  EXPECT_THAT(ErrorOf([&] { Simulation{scene}; }), HasSubstr("radii of the smallest"));
  // A belt, and a disc that turns about its axis, pass nothing however fast they are.
  scene.walls[0].motion = {{.time = 0, .velocity = {60, 0, 0}}};
  EXPECT_EQ(ErrorOf([&] { Simulation{scene}; }), "");
  EXPECT_EQ(ErrorOf([&] { simulation.SetMotion(0, scene.walls[0].motion); }), "");
}

TEST(FastWall, IsRefusedWhereAForceMakesIt) {
  Simulation simulation(Sound());
  const Press slow{.walls = {0}, .force = 1, .mass = 1e-3, .damping = 10};
  EXPECT_EQ(ErrorOf([&] { simulation.SetPresses({slow}); }), "");
  Press fast = slow;
  fast.damping = 1.0 / 60;
  EXPECT_THAT(ErrorOf([&] { simulation.SetPresses({fast}); }), HasSubstr("radii of the smallest"));
  fast = slow;
  fast.speed = -60;
  EXPECT_THAT(ErrorOf([&] { simulation.SetPresses({fast}); }), HasSubstr("radii of the smallest"));
  EXPECT_EQ(simulation.Presses()[0].damping, slow.damping);
}

// A rolling dashpot that is far too strong for the step makes the spin diverge, and with it the
// speed.
TEST(BlowUp, ADivergingSphereIsNamedWithItsSpeed) {
  Scene scene = Sound();
  scene.models.rolling = Rolling::kEpsd;
  scene.models.full_mobilisation_damping = 1;
  scene.materials[0].rolling_damping = 1e5;
  scene.materials[0].rolling_friction = 10;
  scene.particles = {
      {.id = 7, .radius = 1e-3, .position = {0, 0, 1e-3 - 1e-6}, .angular_velocity = {1, 0, 0}}};
  Simulation simulation(scene);
  EXPECT_THAT(ErrorOf([&] { simulation.Advance(100000); }),
              AllOf(HasSubstr("step "), HasSubstr("sphere 7 has a ")));
}

// Spheres of 1 mm in the room above the cloud.
Particle Above(std::int64_t id, double height) {
  return {.id = id, .radius = 1e-3, .position = {0, 0, height}};
}

// Unharmed, the simulation goes on with the bits of one that was never asked.
TEST(BadAdd, RefusesWhatStandsInSomethingAndChangesNothing) {
  Simulation simulation(Sound()), other(Sound());
  simulation.Advance(10);
  other.Advance(10);
  const auto error_of = [&](const std::vector<Particle>& spheres) {
    return ErrorOf([&] { simulation.Add(spheres); });
  };
  EXPECT_THAT(error_of({Above(100, 1.0), Above(101, 1.0)}),
              HasSubstr("spheres[1].position: overlaps spheres[0] by 2.0"));
  EXPECT_THAT(error_of({Above(100, 1.0), Above(101, 1.0 + 1.74e-3)}), HasSubstr("by 0.26"));
  const Vec3 third = simulation.Particles()[3].position;
  EXPECT_THAT(error_of({Above(100, 1.0), {.id = 101, .radius = 1e-3, .position = third}}),
              HasSubstr("spheres[1].position: overlaps the sphere with id 3"));
  EXPECT_THAT(error_of({Above(100, 1.0), Above(101, -1.0)}),
              HasSubstr("spheres[1].position: stands in the wall \"floor\""));
  EXPECT_THAT(error_of({Above(-1, 1.0)}), HasSubstr("spheres[0].id: is -1"));
  simulation.Advance(100);
  other.Advance(100);
  EXPECT_TRUE(simulation.Checkpoint() == other.Checkpoint());
  EXPECT_EQ(error_of({Above(100, 1.0), Above(101, 1.0 + 1.76e-3)}), "");
  simulation.Advance(10);
}

// A large sphere meets small ones beyond the cells next to its own.
TEST(BadAdd, SeesASmallSphereInALargeOneAndTheOtherWayRound) {
  Scene scene = Sound();
  scene.time_step = 1e-7;
  const Particle large{.id = 100, .radius = 0.05, .position = {0.5, 0, 0.1}};
  const Particle small{.id = 101, .radius = 1e-3, .position = {0.51, 0.04, 0.1}};
  for (const auto& [first, second] : {std::pair(large, small), std::pair(small, large)}) {
    scene.particles.resize(8);
    scene.particles.push_back(first);
    Simulation simulation(scene);
    const std::span<const Particle> added(&second, 1);
    EXPECT_THAT(ErrorOf([&] { simulation.Add(added); }),
                HasSubstr("overlaps the sphere with id " + std::to_string(first.id)));
  }
}

TEST(Simulation, IsUnusableOnceItsListCouldNotBeMade) {
  Scene scene = Sound();
  scene.materials[0].youngs_modulus = 1;  // cannot carry its own weight
  scene.particles = {{.id = 42, .radius = 1e-3, .position = {0, 0, 1e-3}}};
  Simulation simulation(scene);
  ASSERT_NE(ErrorOf([&] { simulation.Advance(100000); }), "");
  const std::vector<Particle> more{Above(43, 1.0)};
  const std::vector<std::function<void()>> uses = {
      [&] { simulation.Advance(1); },
      [&] { simulation.Add(more); },
      [&] { simulation.SetMotion(0, {}); },
      [&] { simulation.SetPresses({}); },
      [&] { simulation.SetGravityTurns({}); },
      [&] { simulation.SetMaterial(0, testing::Glass()); },
      [&] { simulation.RemoveWall(0); },
      [&] { simulation.RemoveIf([](const Particle&) { return true; }); },
      [&] { simulation.Particles(); },
      [&] { simulation.Contacts(); },
      [&] { simulation.WallLoads(); },
      [&] { simulation.MaxSpeed(); },
      [&] { simulation.Checkpoint(); }};
  for (const auto& use : uses) EXPECT_THAT(ErrorOf(use), HasSubstr("cannot be used any more"));
}

TEST(Simulation, AnIndexOfNothingIsNamedWithHowManyThereAre) {
  Simulation simulation(Sound());
  const auto is_refused = [](const std::string& name, const std::function<void()>& use) {
    EXPECT_THROW(use(), base::ConfigError);
    EXPECT_THAT(ErrorOf(use), HasSubstr(name + ": is not among the 1 of the simulation"));
  };
  is_refused("wall 99", [&] { simulation.RemoveWall(99); });
  is_refused("wall -1", [&] { simulation.RemoveWall(-1); });
  is_refused("wall 99", [&] { simulation.IsRemoved(99); });
  is_refused("wall 99", [&] { simulation.SetMotion(99, {}); });
  is_refused("material 7", [&] { simulation.SetMaterial(7, testing::Glass()); });
}

TEST(SetMaterial, RefusesWhatTheStepIsTooLongFor) {
  Simulation simulation(Sound());
  Material stiff = testing::Glass();
  stiff.youngs_modulus *= 100;
  EXPECT_THAT(ErrorOf([&] { simulation.SetMaterial(0, stiff); }), HasSubstr("Rayleigh"));
  Material rough = testing::Glass();
  rough.sliding_friction = 0.9;
  EXPECT_EQ(ErrorOf([&] { simulation.SetMaterial(0, rough); }), "");
}

TEST(RemoveIf, TakesOutWhatLeavesAndKeepsTheRest) {
  Simulation simulation(Sound());
  simulation.Advance(100);
  const auto before = simulation.Particles();
  EXPECT_EQ(simulation.RemoveIf([](const Particle& p) { return p.id % 2 == 1; }), 4);
  const auto after = simulation.Particles();
  ASSERT_EQ(after.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(after[i].id, before[2 * i].id);
    EXPECT_EQ(after[i].position, before[2 * i].position);
  }
  simulation.Advance(100);
  EXPECT_EQ(simulation.RemoveIf([](const Particle&) { return true; }), 4);
  simulation.Advance(10);  // nothing is left, and that is no problem
  EXPECT_EQ(simulation.num_particles(), 0);
}

}  // namespace bad_input_test
}  // namespace talus::engine
