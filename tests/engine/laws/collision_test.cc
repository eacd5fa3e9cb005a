// Impacts with known answers.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/engine/scenes.h"

namespace talus::engine {
namespace collision_test {

using ::testing::Combine;
using ::testing::Values;

constexpr double kRadius = 1e-3;

// Δt is this part of the impact's length. The dashpot sees velocities half a step old, which costs
// e about 0.6/steps at e = 0.3: 3e-4 at 2000.
constexpr int kStepsAnImpact = 2000;

testing::HertzImpact Impact(const Material& m, bool wall, double speed) {
  const double mass = SphereMass(m, kRadius);
  return {.y_star = MakePairConstants(m, m, {}).y_star,
          .r_star = wall ? kRadius : kRadius / 2,
          .m_star = wall ? mass : mass / 2,
          .speed = speed};
}

class Restitution : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Restitution, HeadOnCollisionReturnsEAtEverySpeed) {
  const auto [e, speed] = GetParam();
  Material material = testing::Glass();
  material.restitution = e;
  Scene scene = testing::EmptySpace(material);
  const double gap = 1e-9;
  scene.particles = {
      {.id = 0, .radius = kRadius, .position = {0, 0, 0}, .velocity = {speed / 2, 0, 0}},
      {.id = 1,
       .radius = kRadius,
       .position = {2 * kRadius + gap, 0, 0},
       .velocity = {-speed / 2, 0, 0}}};
  scene.time_step = Impact(material, false, speed).Duration() / kStepsAnImpact;
  Simulation simulation(scene);
  simulation.Advance(3 * kStepsAnImpact);
  ASSERT_TRUE(simulation.Contacts().empty());
  const auto after = simulation.Particles();
  EXPECT_NEAR((after[1].velocity.x - after[0].velocity.x) / speed, e, 1e-3);
  EXPECT_NEAR(after[0].velocity.x + after[1].velocity.x, 0, 1e-15 * kStepsAnImpact * speed);
}

TEST_P(Restitution, WallCollisionReturnsEAtEverySpeed) {
  const auto [e, speed] = GetParam();
  Material material = testing::Glass();
  material.restitution = e;
  Scene scene = testing::EmptySpace(material);
  scene.walls = {testing::Floor()};
  scene.particles = {
      {.id = 0, .radius = kRadius, .position = {0, 0, kRadius + 1e-9}, .velocity = {0, 0, -speed}}};
  scene.time_step = Impact(material, true, speed).Duration() / kStepsAnImpact;
  Simulation simulation(scene);
  simulation.Advance(3 * kStepsAnImpact);
  ASSERT_TRUE(simulation.Contacts().empty());
  EXPECT_NEAR(simulation.Particles()[0].velocity.z / speed, e, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(AllSpeeds, Restitution,
                         Combine(Values(0.3, 0.5, 0.7, 0.9, 1.0), Values(0.01, 1.0)));

// What the restitution tests cannot see: the stiffness, which cancels in e.
TEST(Collision, UndampedImpactLastsHertzTime) {
  Material material = testing::Glass();
  material.restitution = 1;
  const double speed = 0.1;
  const testing::HertzImpact impact = Impact(material, false, speed);
  Scene scene = testing::EmptySpace(material);
  scene.particles = {
      {.id = 0, .radius = kRadius, .position = {0, 0, 0}, .velocity = {speed / 2, 0, 0}},
      {.id = 1,
       .radius = kRadius,
       .position = {2 * kRadius, 0, 0},
       .velocity = {-speed / 2, 0, 0}}};
  scene.time_step = impact.Duration() / 5000;  // the length is counted in steps
  Simulation simulation(scene);
  double deepest = 0;
  std::int64_t steps = 0;
  for (bool touched = false; steps < 20000; ++steps) {
    simulation.Advance(1);
    const auto contacts = simulation.Contacts();
    if (contacts.empty() && touched) break;
    touched = touched || !contacts.empty();
    for (const ContactInfo& contact : contacts) deepest = std::max(deepest, contact.overlap);
  }
  EXPECT_NEAR(static_cast<double>(steps) * scene.time_step / impact.Duration(), 1, 1e-3);
  EXPECT_NEAR(deepest / impact.MaxOverlap(), 1, 1e-3);
}

}  // namespace collision_test
}  // namespace talus::engine
