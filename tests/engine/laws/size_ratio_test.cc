// A small sphere on the saddle between two large ones. Schemes that take friction from velocities
// half a step old have been reported to hold it there (Computer Physics Communications 310,
// 109524).
#include <gtest/gtest.h>

#include <tuple>

#include "tests/engine/scenes.h"

namespace talus::engine {
namespace size_ratio_test {

constexpr double kSmall = 0.5e-3;  // radius [m]
constexpr double kGravity = 9.81;

// Two large spheres touch each other, the floor and a wall at either side. The small one lies on
// both, `tilt` off the top of the saddle, at rest.
Scene Saddle(double ratio, double tilt) {
  const double large = ratio * kSmall;
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.materials[0].restitution = 0.5;
  scene.gravity = {0, 0, -kGravity};
  const auto plane = [](Vec3 point, Vec3 normal) {
    return Wall{.name = "side", .shape = Plane{.point = point, .normal = normal}};
  };
  scene.walls = {testing::Floor(), plane({-2 * large, 0, 0}, {1, 0, 0}),
                 plane({2 * large, 0, 0}, {-1, 0, 0})};
  const double arm = std::sqrt((large + kSmall) * (large + kSmall) - large * large);
  scene.particles = {{.id = 0, .radius = large, .position = {-large, 0, large}},
                     {.id = 1, .radius = large, .position = {large, 0, large}},
                     {.id = 2,
                      .radius = kSmall,
                      .position = {0, arm * std::sin(tilt), large + arm * std::cos(tilt)}}};
  return scene;
}

class SizeRatio : public ::testing::TestWithParam<std::tuple<double, double>> {};

// Its centre moves on a circle of radius ρ about the line between the large ones' centres, and it
// rolls: v² (1 + (2/5)(L/ρ)²) = 2gρ (cos φ₀ − cos φ), L = R + r. Contacts give way by 1e-3 of a
// radius and the large spheres recoil by their share of the mass, 1/39 at most: 5 % of the speed.
TEST_P(SizeRatio, ASmallSphereRollsOffTheSaddleOfTwoLargeOnes) {
  const auto [ratio, fraction] = GetParam();
  const double start = 0.1, end = 0.4;  // [rad]
  Scene scene = Saddle(ratio, start);
  scene.rayleigh_fraction = fraction;
  Simulation simulation(scene);
  const double large = ratio * kSmall, reach = large + kSmall;
  const double arm = std::sqrt(reach * reach - large * large);
  double angle = start;
  Particle small;
  while (angle < end && simulation.time() < 1) {
    simulation.Advance(100);
    small = simulation.Particles()[2];
    angle = std::atan2(small.position.y, small.position.z - large);
  }
  ASSERT_GE(angle, end);
  const double inertia = 1 + 0.4 * reach * reach / (arm * arm);
  const double speed =
      std::sqrt(2 * kGravity * arm * (std::cos(start) - std::cos(angle)) / inertia);
  EXPECT_NEAR(base::Norm(small.velocity) / speed, 1, 0.05);
}
INSTANTIATE_TEST_SUITE_P(RatiosAndSteps, SizeRatio,
                         ::testing::Combine(::testing::Values(3.4, 5.0, 10.0),
                                            ::testing::Values(0.15, 0.30)));

}  // namespace size_ratio_test
}  // namespace talus::engine
