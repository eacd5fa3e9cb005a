// Walls that turn, tap and are taken away, gravity that turns, spheres that come later.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "engine/bodies/wall_motion.h"
#include "tests/engine/scenes.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace moving_scene_test {

constexpr double kGravity = 9.81;

Material Rough() {
  Material material = testing::Glass();
  material.youngs_modulus = 1e8;
  return material;
}

// Overlap at which a sphere of 1 mm rests under its weight.
double RestOverlap(const Material& m) {
  const double r = 1e-3, load = SphereMass(m, r) * kGravity;
  return std::pow(load / (4.0 / 3 * MakePairConstants(m, m, {}).y_star * std::sqrt(r)), 2.0 / 3);
}

void AdvanceTo(Simulation& simulation, double time) {
  simulation.Advance(std::llround((time - simulation.time()) / simulation.time_step()));
}

// A ball that rolls on a turntable of angular velocity Ω runs on a circle with 2Ω/7, whatever its
// speed. A wall whose surface moved with its centre would let it run straight on.
TEST(TurningWall, ABallOnATurntableRunsOnACircleAtTwoSeventhsOfItsSpeed) {
  const double r = 1e-3, turning = 5;
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  const Vec3 start{20e-3, 0, r - RestOverlap(scene.materials[0])};
  const Vec3 velocity{0, 0.05, 0};
  // Rolling: v + ω × (−r z) = Ω × x.
  const Vec3 slip = Cross(Vec3{0, 0, turning}, start) - velocity;
  scene.particles = {{.radius = r,
                      .position = start,
                      .velocity = velocity,
                      .angular_velocity = {slip.y / r, -slip.x / r, 0}}};
  scene.walls = {{.name = "table",
                  .shape = Disc{.center = {}, .radius = 0.2},
                  .motion = {{.time = 0, .angular_velocity = {0, 0, turning}}}}};
  Simulation simulation(scene);
  const double period = 2 * std::numbers::pi / (2.0 / 7 * turning);
  AdvanceTo(simulation, period / 4);
  Vec3 now = simulation.Particles()[0].velocity;
  // Contact stiffness lets it creep by 0.1 % of a turn.
  EXPECT_NEAR(now.x / 0.05, -1, 0.01);
  EXPECT_NEAR(now.y / 0.05, 0, 0.01);
  AdvanceTo(simulation, period / 2);
  now = simulation.Particles()[0].velocity;
  EXPECT_NEAR(now.x / 0.05, 0, 0.02);
  EXPECT_NEAR(now.y / 0.05, -1, 0.02);
}

// In a drum a ball without rolling resistance stays at the bottom and spins with the wall:
// r ω = R Ω.
TEST(TurningWall, ABallInADrumSpinsWithItsWall) {
  const double r = 1e-3, big = 20e-3, turning = 3;
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  scene.particles = {{.radius = r,
                      .position = {0, 0, -big + r - RestOverlap(scene.materials[0])},
                      .angular_velocity = {0, 0.8 * turning * big / r, 0}}};
  scene.walls = {
      {.name = "drum",
       .shape =
           OpenCylinder{.base = {0, -0.05, 0}, .axis = {0, 1, 0}, .radius = big, .length = 0.1},
       .motion = {{.time = 0, .angular_velocity = {0, turning, 0}}},
       .pivot = Vec3{0, 0.3, 0}}};
  Simulation simulation(scene);
  const std::int64_t rebuilds = simulation.Statistics().num_rebuilds;
  AdvanceTo(simulation, 0.5);
  const Particle ball = simulation.Particles()[0];
  // It swings a little at first; where it slips no more, its surface moves as the drum's does:
  // v + r ω = R Ω, with x turning about the drum's axis.
  const double wall_speed = turning * big;
  const double tangential = -ball.velocity.x;  // at the bottom, Ω e_y moves the wall along −x
  EXPECT_NEAR((tangential + ball.angular_velocity.y * r) / wall_speed, 1, 5e-3);
  // Nothing but the ball moves: the list is not made anew for a wall that stays where it is.
  EXPECT_LT(simulation.Statistics().num_rebuilds - rebuilds, 400);
}

// A plate that swings up about its edge carries its normal and its centre along exactly.
TEST(TurningWall, ATiltedPlateIsWhereItsAngleSays) {
  Scene scene = testing::EmptySpace(Rough());
  const double turning = 2;
  scene.time_step = 1e-5;
  scene.walls = {{.name = "plate",
                  .shape = Rectangle{.center = {0.05, 0, 0}, .width = 0.1, .height = 0.04},
                  .motion = {{.time = 0.01003, .angular_velocity = {0, -turning, 0}},
                             {.time = 0.31111, .velocity = {0, 0.5, 0}},
                             {.time = 0.4}},
                  .pivot = Vec3{0, 0, 0}}};
  Simulation simulation(scene);
  simulation.Advance(50000);
  const double angle = turning * (0.31111 - 0.01003);
  const double way = 0.5 * (0.4 - 0.31111);
  const auto& plate = std::get<Rectangle>(simulation.Walls()[0].shape);
  // Rounding: 30 000 turns of 1e-16.
  EXPECT_LT(base::Norm(plate.normal - Vec3{-std::sin(angle), 0, std::cos(angle)}), 1e-11);
  EXPECT_LT(base::Norm(plate.edge - Vec3{std::cos(angle), 0, std::sin(angle)}), 1e-11);
  EXPECT_LT(base::Norm(plate.center - Vec3{0.05 * std::cos(angle), way, 0.05 * std::sin(angle)}),
            1e-11);
}

// Gravity that turns from the start gives a free sphere x = g(Ωt − sin Ωt)/Ω², z = −g(1 − cos
// Ωt)/Ω².
TEST(TurningGravity, AFreeSphereFallsAsTheIntegralSays) {
  const double turning = 7;
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  scene.gravity_turns = {{.time = 0, .angular_velocity = {0, -turning, 0}}};
  scene.particles = {{.radius = 1e-3}};
  Simulation simulation(scene);
  AdvanceTo(simulation, 0.3);
  const double phase = turning * simulation.time(), scale = kGravity / (turning * turning);
  const Vec3 at = simulation.Particles()[0].position;
  // The leapfrog's error is (Ω Δt)² of the way.
  EXPECT_NEAR(at.x, scale * (phase - std::sin(phase)), 1e-6);
  EXPECT_NEAR(at.z, -scale * (1 - std::cos(phase)), 1e-6);
  EXPECT_NEAR(base::Norm(simulation.Gravity()), kGravity, 1e-12);
}

// On a slope, a sphere with elastic-plastic rolling resistance stays until tan θ = μ_r.
TEST(TurningGravity, ASphereOnATiltedPlaneRollsFromTheRollingFrictionOn) {
  Material material = Rough();
  material.rolling_friction = 0.2;
  Scene scene = testing::EmptySpace(material);
  scene.models.rolling = Rolling::kEpsd;
  scene.gravity = {0, 0, -kGravity};
  const double turning = 0.5, angle = std::atan(0.2);
  scene.gravity_turns = {{.time = 0, .angular_velocity = {0, -turning, 0}}};
  scene.particles = {{.radius = 1e-3, .position = {0, 0, 1e-3 - RestOverlap(material)}}};
  scene.walls = {testing::Floor()};
  Simulation simulation(scene);
  AdvanceTo(simulation, 0.97 * angle / turning);
  EXPECT_LT(simulation.MaxSpeed(), 1e-3);
  AdvanceTo(simulation, 1.1 * angle / turning);
  const double t = 0.1 * angle / turning;
  // Beyond it, a = 5/7 g (sin θ − μ_r cos θ) ≈ 5/7 g cos θ (1 + tan² θ) Ω t.
  const double expected = 5.0 / 7 * kGravity * std::cos(angle) * (1 + 0.04) * turning * t * t / 2;
  EXPECT_NEAR(simulation.MaxSpeed() / expected, 1, 0.1);
}

TEST(Gate, ASphereFallsFromTheTimeAtWhichItsFloorIsTakenAway) {
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  const double start = 1e-3 - RestOverlap(scene.materials[0]);
  scene.particles = {{.radius = 1e-3, .position = {0, 0, start}}};
  scene.walls = {{.name = "gate",
                  .shape = Rectangle{.center = {}, .width = 0.01, .height = 0.01},
                  .removal_time = 0.05}};
  Simulation simulation(scene);
  AdvanceTo(simulation, 0.049);
  EXPECT_NEAR(simulation.Particles()[0].position.z, start, 1e-9);
  AdvanceTo(simulation, 0.1);
  const double fall = simulation.time() - 0.05;
  // Half a step and the contact's push of its overlap, 0.5 µm, at 0.5 m/s.
  EXPECT_NEAR(simulation.Particles()[0].position.z, start - kGravity / 2 * fall * fall, 5e-6);
}

// However the steps fall, the cup rises to the height of the tap and comes back to its place.
TEST(Taps, ThousandTapsLeaveTheCupWhereItWas) {
  const Taps taps{.start = 1e-3, .count = 1000, .height = 3e-3, .interval = 0.1};
  const std::vector<MotionStep> motion = TapMotion(taps);
  const double dt = 1.7e-5;
  double height = 0, highest = 0;
  for (std::int64_t step = 0; step * dt < 100.1; ++step) {
    height += dt * MotionOver(motion, step * dt, dt).velocity.z;
    highest = std::max(highest, height);
  }
  EXPECT_NEAR(height, 0, 1e-12);
  EXPECT_NEAR(highest, 3e-3, 3e-6);  // between two steps
}

// What lies in the cup falls with it: it presses on the floor with nothing meanwhile, and with more
// than its weight when the cup is lifted.
TEST(Taps, ASphereInTheCupIsWeightlessWhileItFalls) {
  const Taps taps{.start = 0.01, .count = 1, .height = 3e-3, .interval = 0.1};
  Scene scene = testing::EmptySpace(Rough());
  scene.materials[0].restitution = 0.1;
  scene.gravity = {0, 0, -kGravity};
  scene.particles = {{.radius = 1e-3, .position = {0, 0, 1e-3 - RestOverlap(Rough())}}};
  scene.walls = {testing::Floor()};
  scene.walls[0].motion = TapMotion(taps);
  const double weight = SphereMass(scene.materials[0], 1e-3) * kGravity;
  Simulation simulation(scene);
  AdvanceTo(simulation, 0.009);
  EXPECT_NEAR(-simulation.WallLoads()[0].force.z / weight, 1, 1e-3);
  AdvanceTo(simulation, 0.01 + 0.95 * TapDuration(taps));
  EXPECT_NEAR(simulation.WallLoads()[0].force.z / weight, 0, 1e-3);
  AdvanceTo(simulation, 0.3);
  EXPECT_NEAR(-simulation.WallLoads()[0].force.z / weight, 1, 1e-2);
  EXPECT_NEAR(simulation.Particles()[0].position.z, 1e-3 - RestOverlap(Rough()), 1e-7);
}

// A sphere at rest gives its weight, and its weight times its place, to the plate's pivot.
TEST(WallLoads, ForceAndTorqueOfAWeight) {
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  scene.particles = {{.radius = 1e-3, .position = {4e-3, 0, 1e-3 - RestOverlap(Rough())}}};
  scene.walls = {
      {.name = "plate", .shape = Disc{.center = {}, .radius = 0.01}, .pivot = Vec3{-1e-3, 0, 0}}};
  Simulation simulation(scene);
  const double weight = SphereMass(scene.materials[0], 1e-3) * kGravity;
  const WallLoad load = simulation.WallLoads()[0];
  EXPECT_NEAR(load.force.z / weight, -1, 1e-6);
  EXPECT_NEAR(load.torque.y / (weight * 5e-3), 1, 1e-6);  // r × F = (5 mm)(−W)(x × z) = +y
}

// The weight of a sphere that rolls over the middle of a plate has no lever. What resists its
// rolling turns the plate by μ_r R N along with it: without it nothing would.
TEST(WallLoads, RollingResistanceTurnsTheWall) {
  Material material = Rough();
  material.rolling_friction = 0.2;
  Scene scene = testing::EmptySpace(material);
  scene.models.rolling = Rolling::kConstant;
  scene.gravity = {0, 0, -kGravity};
  scene.particles = {{.radius = 1e-3,
                      .position = {0, 0, 1e-3 - RestOverlap(material)},
                      .velocity = {0.1, 0, 0},
                      .angular_velocity = {0, 100, 0}}};
  scene.walls = {{.name = "plate", .shape = Disc{.center = {}, .radius = 0.01}}};
  Simulation simulation(scene);
  const double weight = SphereMass(scene.materials[0], 1e-3) * kGravity;
  EXPECT_NEAR(simulation.WallLoads()[0].torque.y / (0.2 * 1e-3 * weight), 1, 0.01);
}

TEST(Add, ASphereThatComesLaterFallsFromThen) {
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  scene.time_step = 1e-6;
  Simulation simulation(scene);
  simulation.Advance(1000);
  const std::vector<Particle> one{
      {.id = 7, .radius = 1e-3, .position = {0, 0, 1}, .velocity = {0.1, 0, -0.2}}};
  simulation.Add(one);
  simulation.Advance(1000);
  const Particle now = simulation.Particles().at(0);
  EXPECT_EQ(now.id, 7);
  EXPECT_NEAR(now.position.z, 1 - 0.2e-3 - kGravity / 2 * 1e-6, 1e-12);
  EXPECT_NEAR(now.velocity.z, -0.2 - kGravity * 1e-3, 1e-12);
  EXPECT_THROW(simulation.Add(one), base::ConfigError);  // its number is in use
}

TEST(Add, AStepTooLongForASphereIsSaid) {
  Scene scene = testing::EmptySpace(Rough());
  scene.time_step = 1e-6;
  Simulation simulation(scene);
  const auto error_of = [&](const Particle& p) {
    return ErrorIn([&] { simulation.Add({&p, 1}); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error_of({.id = 8, .radius = 1e-6}), HasSubstr("0.4 Rayleigh times"));
  EXPECT_THAT(error_of({.id = 9, .radius = 1e-3, .velocity = {0, 0, -600}}),  // 0.6 radii a step
              HasSubstr("velocity"));
  EXPECT_THAT(error_of({.id = 9, .radius = 1e-3, .angular_velocity = {0, 2e6, 0}}),
              HasSubstr("angular_velocity"));
  EXPECT_EQ(error_of({.id = 9, .radius = 1e-3}), "");
}

// Rolling resistance is of what turns against the other: a ball that a drum carries along as if it
// were a part of it is not resisted. Five steps of a wall taken for standing would take 1e-3 of it.
TEST(TurningWall, WhatTurnsWithItAsOneBodyIsNotResisted) {
  const double r = 1e-3, big = 20e-3, turning = 30;
  Material material = testing::Glass();
  material.rolling_friction = 0.5;
  for (const Rolling rolling : {Rolling::kEpsd, Rolling::kEpsd2}) {
    Scene scene = testing::EmptySpace(material);
    scene.models.rolling = rolling;
    scene.particles = {{.radius = r,
                        .position = {0, 0, -big + r - 1e-6},
                        .velocity = {-turning * (big - r), 0, 0},
                        .angular_velocity = {0, turning, 0}}};
    scene.walls = {
        {.name = "drum",
         .shape =
             OpenCylinder{.base = {0, -0.05, 0}, .axis = {0, 1, 0}, .radius = big, .length = 0.1},
         .motion = {{.time = 0, .angular_velocity = {0, turning, 0}}}}};
    Simulation simulation(scene);
    simulation.Advance(5);
    EXPECT_NEAR(simulation.Particles()[0].angular_velocity.y / turning, 1, 1e-4)
        << base::NameOf(rolling);
  }
}

TEST(Turned, AThirdOfATurnAboutTheDiagonalExchangesTheAxes) {
  const double third = 2 * std::numbers::pi / 3 / std::sqrt(3.0);
  EXPECT_LT(base::Norm(Turned({1, 2, 3}, {third, third, third}) - Vec3{3, 1, 2}), 1e-14);
}

TEST(MovingScene, ARestartGoesOnWithTheSameBits) {
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -kGravity};
  scene.gravity_turns = {{.time = 0, .angular_velocity = {0, 1, 0}}};
  for (int i = 0; i < 20; ++i) {
    scene.particles.push_back({.id = i, .radius = 1e-3, .position = {0, 0, 2e-3 * (i + 1)}});
  }
  scene.walls = {{.name = "a",
                  .shape = Rectangle{.center = {}, .width = 0.02, .height = 0.02},
                  .motion = {{.time = 1e-3, .velocity = {}, .acceleration = {0, 0, 1}},
                             {.time = 3e-3, .angular_velocity = {1, 2, 0}}},
                  .pivot = Vec3{0.01, 0, 0}},
                 {.name = "b",
                  .shape = Cone{.base = {}, .radius = 5e-3, .top_radius = 8e-3, .length = 0.1},
                  .motion = {{.time = 0, .angular_velocity = {0, 0, 30}}},
                  .removal_time = 4e-3}};
  Simulation whole(scene);
  Simulation first(scene);
  whole.Advance(3000);
  first.Advance(1234);
  Simulation second = Simulation::Restore(first.Checkpoint());
  second.Advance(3000 - 1234);
  EXPECT_GT(whole.time(), 4e-3);
  EXPECT_TRUE(whole.Checkpoint() == second.Checkpoint());
}

TEST(BadMotion, IsRefused) {
  const auto problems_of = [](const Wall& wall) {
    base::Problems problems;
    Scene scene = testing::EmptySpace(Rough());
    scene.walls = {wall};
    scene.Validate(problems);
    std::string text;
    for (const base::Problem& p : problems.list()) text += p.path + ": " + p.Text() + "\n";
    return text;
  };
  Wall plane = testing::Floor();
  plane.motion = {{.time = 0, .angular_velocity = {0, 1, 0}}};
  EXPECT_NE(problems_of(plane).find("turns a plane"), std::string::npos);
  plane.motion = {{.time = 0, .velocity = {}, .acceleration = {0, 0, 1}}};
  EXPECT_NE(problems_of(plane).find("for ever"), std::string::npos);
  const Wall edge{
      .name = "e",
      .shape = Rectangle{.normal = {1, 0, 0}, .edge = {2, 0, 0}, .width = 1, .height = 1}};
  EXPECT_NE(problems_of(edge).find("shape.edge"), std::string::npos);
  const Wall hole{.name = "h", .shape = Annulus{.inner_radius = 2, .radius = 1}};
  EXPECT_NE(problems_of(hole).find("above inner_radius"), std::string::npos);
}

}  // namespace moving_scene_test
}  // namespace talus::engine
