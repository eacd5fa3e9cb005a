// Things that must stay where they are, and scenes that are turned as a whole.
#include <gtest/gtest.h>

#include "tests/engine/cloud.h"

namespace talus::engine {
namespace rest_test {

// 27 spheres fall into a small box and come to rest; then nothing may move for 1e5 steps. Creep of
// a bad tangential spring is micrometres; a contact's own overlap here is 1e-7 m. Springs in single
// precision may lose 6e-8 of themselves a step, 6e-3 in all: some 1e-9 m, and more where a few add
// up.
TEST(Block, AtRestStaysAtRestForAHundredThousandSteps) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.models.rolling = Rolling::kEpsd;
  scene.gravity = {0, 0, -9.81};
  scene.particles = testing::Cloud({.per_side = 3, .speed = 0.05});
  scene.walls = testing::Box(3 * 2.1e-3);
  Simulation simulation(scene);
  simulation.Advance(60000);
  const auto before = simulation.Particles();
  EXPECT_LT(simulation.MaxSpeed(), 1e-7);
  simulation.Advance(100000);
  const auto after = simulation.Particles();
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT(base::Norm(after[i].position - before[i].position), 1e-8) << i;
  }
}

Vec3 Turned(const Vec3& a) {  // by 40° about (1,2,3)/√14, Rodrigues
  const Vec3 axis = Vec3{1, 2, 3} / std::sqrt(14.0);
  const double angle = 40 * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  return c * a + s * base::Cross(axis, a) + (1 - c) * base::Dot(axis, a) * axis;
}

struct TurnWall {
  void operator()(Plane& s) const { Turn(s.point, s.normal); }
  void operator()(Disc& s) const { Turn(s.center, s.normal); }
  void operator()(Annulus& s) const { Turn(s.center, s.normal); }
  void operator()(Rectangle& s) const {
    Turn(s.center, s.normal);
    s.edge = Turned(s.edge);
  }
  void operator()(Cone& s) const { Turn(s.base, s.axis); }
  void operator()(OpenCylinder& s) const { Turn(s.base, s.axis); }
  void operator()(SolidCylinder& s) const { Turn(s.base, s.axis); }
  static void Turn(Vec3& a, Vec3& b) {
    a = Turned(a);
    b = Turned(b);
  }
};

// Round-off of single precision (1e-8 m/s here) grows by collisions, about tenfold each; each
// sphere has a few in this time.
TEST(Rotation, TurningTheSceneTurnsTheResult) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.models.rolling = Rolling::kEpsd;
  scene.gravity = {0, 0, -9.81};
  scene.particles = testing::Cloud({.per_side = 4, .spacing = 1.8e-3});
  const double middle = 2 * 1.8e-3;
  scene.walls = {
      {.name = "base",
       .shape = SolidCylinder{.base = {middle, middle, -2e-3}, .radius = 4e-3, .length = 2e-3}},
      {.name = "tube",
       .shape = OpenCylinder{.base = {middle, middle, 0}, .radius = 7e-3, .length = 9e-3},
       .motion = {{.time = 0, .velocity = {0, 0, 0.1}}}}};
  Scene turned = scene;
  turned.gravity = Turned(turned.gravity);
  for (Particle& p : turned.particles) {
    p.position = Turned(p.position);
    p.velocity = Turned(p.velocity);
    p.angular_velocity = Turned(p.angular_velocity);
  }
  for (Wall& wall : turned.walls) {
    std::visit(TurnWall{}, wall.shape);
    for (MotionStep& step : wall.motion) step.velocity = Turned(step.velocity);
  }
  Simulation straight(scene), other(turned);
  straight.Advance(20);
  EXPECT_GT(straight.Contacts().size(), 10u);
  straight.Advance(180);
  other.Advance(200);
  const auto a = straight.Particles(), b = other.Particles();
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT(base::Norm(Turned(a[i].position) - b[i].position), 1e-8) << i;
    EXPECT_LT(base::Norm(Turned(a[i].velocity) - b[i].velocity), 3e-6) << i;
    EXPECT_LT(1e-3 * base::Norm(Turned(a[i].angular_velocity) - b[i].angular_velocity), 1e-5) << i;
  }
}

}  // namespace rest_test
}  // namespace talus::engine
