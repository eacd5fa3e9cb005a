// A sphere that rolls on a plate, for each law of rolling resistance.
#include <gtest/gtest.h>

#include "tests/engine/claim.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace rolling_test {

constexpr double kRadius = 1e-3;
constexpr double kGravity = 9.81;

// On the floor at the overlap that carries its weight, so that it does not bounce.
Scene SphereOnPlate(Rolling rolling) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.models.rolling = rolling;
  scene.gravity = {0, 0, -kGravity};
  scene.walls = {testing::Floor()};
  const Material& m = scene.materials[0];
  const double stiffness = 4.0 / 3 * MakePairConstants(m, m, {}).y_star * std::sqrt(kRadius);
  const double overlap = std::pow(SphereMass(m, kRadius) * kGravity / stiffness, 2.0 / 3);
  scene.particles = {{.radius = kRadius, .position = {0, 0, kRadius - overlap}}};
  return scene;
}

Scene RollingSphere(Rolling rolling, double speed) {
  Scene scene = SphereOnPlate(rolling);
  scene.particles[0].velocity = {speed, 0, 0};
  scene.particles[0].angular_velocity = {0, speed / kRadius, 0};
  return scene;
}

class RollingLaw : public ::testing::TestWithParam<Rolling> {};

// Deceleration μ_r g/1.4. Until an EPSD spring has wound up it is less; a longer run makes that
// less than the tolerance.
TEST_P(RollingLaw, DeceleratesByItsLimit) {
  const double speed = 0.3;
  Simulation simulation(RollingSphere(GetParam(), speed));
  const double wind_up = 0.02, end = 0.2;  // [s]; it stops at 0.43 s
  const auto advance_to = [&](double time) {
    simulation.Advance(std::llround((time - simulation.time()) / simulation.time_step()));
    return simulation.Particles()[0].velocity.x;
  };
  const double first = advance_to(wind_up), start = simulation.time();
  const double second = advance_to(end);
  const double deceleration = (first - second) / (simulation.time() - start);
  testing::Formula("μ_r g/1.4");
  testing::Verify({"deceleration", deceleration, 0.1 * kGravity / 1.4, 1e-3});
}
INSTANTIATE_TEST_SUITE_P(Limited, RollingLaw,
                         ::testing::Values(Rolling::kConstant, Rolling::kEpsd, Rolling::kEpsd2));

// T_r = μ_r R* F_n |ω R|: v decays exponentially at the rate μ_r g/1.4 per m/s.
TEST(ViscousRolling, SpeedDecaysExponentially) {
  const double speed = 0.3;
  Simulation simulation(RollingSphere(Rolling::kViscous, speed));
  simulation.Advance(std::llround(0.2 / simulation.time_step()));
  const double expected = speed * std::exp(-0.1 * kGravity / 1.4 * simulation.time());
  testing::Formula("v exp(−μ_r g t/1.4), t in s, v in m/s");
  testing::Verify({"speed", simulation.Particles()[0].velocity.x, expected, 1e-3});
}

TEST(EpsdRolling, BringsASphereToRestWhereItStays) {
  Simulation simulation(RollingSphere(Rolling::kEpsd, 0.05));
  const auto steps = std::llround(0.2 / simulation.time_step());
  simulation.Advance(steps);  // it stops at 0.07 s, then swings and comes to rest
  const Particle rest = simulation.Particles()[0];
  EXPECT_LT(base::Norm(rest.velocity), 1e-6);
  EXPECT_LT(kRadius * base::Norm(rest.angular_velocity), 1e-6);
  simulation.Advance(steps);
  EXPECT_LT(base::Norm(simulation.Particles()[0].position - rest.position), 1e-9);
}

// Below its limit and with e = 1 the sphere rocks on two springs. With s = Rφ and k_r = k_t R²,
//
//   m ẍ = −k_t (x − s)      (2/5) m s̈ = k_t (x − s) − k_t s      ω² = (3 − √6.5) k_t/m, the slower
//
// s = (1 − ω² m/k_t) x in that mode. The first force finds the springs a step's way long, so that
// it rocks about −ẋ Δt: 2 ω Δt = 1.2e-3 of the amplitude.
TEST(Epsd2Rolling, RocksForEverAtTheFrequencyOfItsSprings) {
  Scene scene = SphereOnPlate(Rolling::kEpsd2);
  scene.materials[0].restitution = 1;
  scene.time_step = 2e-7;
  const Material& m = scene.materials[0];
  const double overlap = kRadius - scene.particles[0].position.z;
  const double stiffness =
      MakePairConstants(m, m, {}).shear_stiffness * std::sqrt(kRadius * overlap);
  const double ratio = 3 - std::sqrt(6.5);
  const double omega = std::sqrt(ratio * stiffness / SphereMass(m, kRadius));
  const double speed = 1e-4;  // [m/s]; from 2.6e-4 on it meets its limit
  scene.particles[0].velocity = {speed, 0, 0};
  scene.particles[0].angular_velocity = {0, (1 - ratio) * speed / kRadius, 0};
  Simulation simulation(scene);
  const double amplitude = speed / omega;
  while (omega * simulation.time() < 20 * std::numbers::pi) {
    simulation.Advance(500);
    const double expected = amplitude * std::sin(omega * simulation.time());
    ASSERT_NEAR(simulation.Particles()[0].position.x, expected, 2e-3 * amplitude);
  }
}

// On a slope the torque m g sinα R meets its limit μ_r R m g cosα at tanα = μ_r.
TEST(EpsdRolling, HoldsOnASlopeBelowItsLimitAndRollsAboveIt) {
  for (const double share : {0.9, 1.1}) {
    Scene scene = SphereOnPlate(Rolling::kEpsd);
    const double slope = std::atan(share * 0.1);
    scene.gravity = {kGravity * std::sin(slope), 0, -kGravity * std::cos(slope)};
    Simulation simulation(scene);
    simulation.Advance(std::llround(0.5 / simulation.time_step()));
    const double speed = simulation.Particles()[0].velocity.x;
    if (share < 1) {
      EXPECT_LT(speed, 1e-6);
    } else {  // (5/7) g (sinα − μ_r cosα), from about the start on
      const double pull = 5.0 / 7 * kGravity * (std::sin(slope) - 0.1 * std::cos(slope));
      EXPECT_NEAR(speed / (pull * simulation.time()), 1, 0.05);
    }
  }
}

// The constant law has a direction and no memory: below its limit it turns about from step to step,
// and the sphere creeps by what is left over, a few times g sinα Δt (docs/physics.md, 6).
TEST(ConstantRolling, CreepsOnASlopeByAFewTimesWhatGravityGivesInAStep) {
  for (const double fraction : {0.15, 0.30}) {
    for (const double share : {0.25, 0.5, 0.9}) {
      Scene scene = SphereOnPlate(Rolling::kConstant);
      scene.rayleigh_fraction = fraction;
      const double slope = std::atan(share * 0.1);
      scene.gravity = {kGravity * std::sin(slope), 0, -kGravity * std::cos(slope)};
      Simulation simulation(scene);
      simulation.Advance(std::llround(0.2 / simulation.time_step()));
      const double start = simulation.Particles()[0].position.x, time = simulation.time();
      simulation.Advance(std::llround(0.5 / simulation.time_step()));
      const double creep =
          (simulation.Particles()[0].position.x - start) / (simulation.time() - time);
      const double step_speed = kGravity * std::sin(slope) * simulation.time_step();
      EXPECT_GT(creep, 2 * step_speed);
      EXPECT_LT(creep, 3 * step_speed);
    }
  }
}

class AnyRolling : public ::testing::TestWithParam<Rolling> {};

// No law may see the twist about the normal: the only torques on this sphere are round-off.
TEST_P(AnyRolling, TwistAboutTheNormalIsKept) {
  Scene scene = SphereOnPlate(GetParam());
  scene.particles[0].angular_velocity = {0, 0, 50};
  Simulation simulation(scene);
  simulation.Advance(20000);
  EXPECT_NEAR(simulation.Particles()[0].angular_velocity.z, 50, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(All, AnyRolling,
                         ::testing::Values(Rolling::kNone, Rolling::kConstant, Rolling::kViscous,
                                           Rolling::kEpsd, Rolling::kEpsd2));

}  // namespace rolling_test
}  // namespace talus::engine
