// Each law at one contact in one step, by its formula: what a whole collision averages out.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/laws/law_list.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace one_contact_test {

// Along x, at rest.
Contact<double> Still(double overlap) {
  Contact<double> contact{};
  contact.normal = {1, 0, 0};
  contact.overlap = overlap;
  contact.r_star = 1e-3;
  contact.root_m_star = 1e-5;
  contact.root_i_star = 1e-8;
  return contact;
}

// What adheres presses nothing: with DMT friction and rolling resistance are limited by the
// Hertzian force (T2, R4).
TEST(OneContact, DmtAdhesionEntersNeitherLimit) {
  Material material = testing::Glass();
  material.surface_energy = 2e-2;
  const PairConstants pair = MakePairConstants(material, material, {.adhesion = Adhesion::kDmt});
  Contact<double> contact = Still(1e-6);
  contact.closing_speed = 0.01;
  const ContactArea<double> area = MakeContactArea(contact);
  const double hertz = HertzForce(pair, contact, area);
  const NormalForce<double> force = DmtAdhesion::Force(pair, contact, area);
  EXPECT_DOUBLE_EQ(force.friction, hertz);
  EXPECT_DOUBLE_EQ(force.rolling, hertz);
  EXPECT_NEAR(force.total / (hertz - 2 * std::numbers::pi * 4e-2 * 1e-3), 1, 1e-12);
}

// A spring that the pair has turned away from its tangent plane is turned back into it (K4).
template <class Limit>
void SpringStaysTangential() {
  const PairConstants pair = MakePairConstants(testing::Glass(), testing::Glass(), {});
  const Contact<double> contact = Still(1e-6);
  const ContactArea<double> area = MakeContactArea(contact);
  Vector<double> spring{3e-9, 4e-9, 0};
  const Vector<double> force =
      Limit::template Force<double>(pair, contact, area, 1.0, 1e-6, spring);
  EXPECT_EQ(spring.x, 0);
  EXPECT_DOUBLE_EQ(spring.y, 4e-9);
  EXPECT_EQ(force.x, 0);
  EXPECT_NEAR(force.y / (pair.shear_stiffness * area.s * 4e-9), 1, 1e-12);
}
TEST(OneContact, ASpringLimitedByTheTotalForceStaysTangential) {
  SpringStaysTangential<TotalForceLimit>();
}
TEST(OneContact, ASpringLimitedByTheElasticForceStaysTangential) {
  SpringStaysTangential<ElasticForceLimit>();
}

// "Else 0" of T4.
TEST(OneContact, WhereTheDashpotAloneExceedsTheElasticLimitTheSpringIsEmptied) {
  const PairConstants pair = MakePairConstants(testing::Glass(), testing::Glass(),
                                               {.coulomb_limit = CoulombLimit::kElasticForce});
  Contact<double> contact = Still(1e-9);
  contact.sliding = {0, 1, 0};
  const ContactArea<double> area = MakeContactArea(contact);
  const double limit = pair.sliding_friction * pair.normal_stiffness * area.s * contact.overlap;
  ASSERT_GT(pair.tangential_damping * area.root_s * contact.root_m_star, limit);
  Vector<double> spring{};
  const Vector<double> force = ElasticForceLimit::Force(pair, contact, area, 0.0, 1e-9, spring);
  EXPECT_NEAR(force.y / limit, 1, 1e-12);
  EXPECT_EQ(spring.y, 0);
}

// M = −(k_r Δt + C_r) ω with k_r = 2.25 k_n μ_r² R*² and C_r = 2 η_r √(I* k_r) (R1, R3); I* of
// two equal spheres about their contact is 7/5 m r² / 2.
TEST(OneContact, TheFirstTorqueOfEpsdIsThatOfSpringAndDashpot) {
  const Material material = testing::Glass();
  const PairConstants pair = MakePairConstants(material, material, {});
  const double r = 1e-3, mass = SphereMass(material, r), inertia = 0.4 * mass * r * r;
  const double overlap = 1e-6, dt = 1e-7, omega = 1e-3;
  const Body<double> i{r, 1 / mass, 1 / inertia, {}, {0, omega, 0}};
  const Body<double> j{r, 1 / mass, 1 / inertia, {}, {}};
  const Contact<double> contact =
      MakeContact<double>({1, 0, 0}, overlap, r / 2, {0, r * omega, 0}, i, j);
  const double k_n = 4.0 / 3 * pair.y_star * std::sqrt(r / 2 * overlap);
  const double k_r = 2.25 * k_n * std::pow(material.rolling_friction * r / 2, 2);
  const double c_r = 2 * material.rolling_damping * std::sqrt(1.4 * mass * r * r / 2 * k_r);
  Vector<double> moment{};
  const ContactArea<double> area = MakeContactArea(contact);
  const Vector<double> torque =
      EpsdRolling::Torque(pair, RollingState<double>{contact, area, 1.0, dt}, moment);
  EXPECT_NEAR(torque.y / (-(k_r * dt + c_r) * omega), 1, 1e-12);
  EXPECT_NEAR(moment.y / (-k_r * dt * omega), 1, 1e-12);
}

// Its speed is that of the surfaces along the tangent plane: ω × n.
TEST(OneContact, TwistAddsNothingToTheViscousTorque) {
  const PairConstants pair = MakePairConstants(testing::Glass(), testing::Glass(), {});
  Contact<double> contact = Still(1e-6);
  const ContactArea<double> area = MakeContactArea(contact);
  const auto torque = [&](double twist) {
    contact.spin = {twist, 2, 0};
    contact.surface = {1e-3 * twist, 2e-3, 0};
    Vector<double> moment{};
    return ViscousRolling::Torque(pair, RollingState<double>{contact, area, 1.0, 1e-6}, moment).y;
  };
  EXPECT_DOUBLE_EQ(torque(50), torque(0));
}

// A7 is of grains: at a wall the spring is shortened by either form, whether the wall turns or not.
TEST(OneContact, AtAWallTheSpringOfJkrIsShortenedByBothForms) {
  Material material = testing::Glass();
  material.surface_energy = 2e-2;
  const auto velocity = [&](JkrSlidingSpring form, double turning) {
    Scene scene = testing::EmptySpace(material);
    scene.models = {
        .adhesion = Adhesion::kJkr, .rolling = Rolling::kNone, .jkr_sliding_spring = form};
    scene.particles = {{.radius = 1e-3, .position = {0, 0, 1e-3 - 1e-6}, .velocity = {0.5, 0, 0}}};
    scene.walls = {{.name = "table",
                    .shape = Disc{.center = {}, .radius = 0.2},
                    .motion = {{.time = 0, .angular_velocity = {0, 0, turning}}}}};
    Simulation simulation(scene);
    simulation.Advance(2000);
    EXPECT_EQ(simulation.Contacts().size(), 1u);
    return simulation.Particles()[0].velocity;
  };
  for (const double turning : {0.0, 20.0}) {
    EXPECT_EQ(velocity(JkrSlidingSpring::kKept, turning),
              velocity(JkrSlidingSpring::kShortened, turning));
  }
}

}  // namespace one_contact_test
}  // namespace talus::engine
