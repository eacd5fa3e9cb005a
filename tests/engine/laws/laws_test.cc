// The laws by themselves, in double precision, against numbers that do not come from this program.
#include <gtest/gtest.h>

#include <numbers>

#include "engine/laws/law_list.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace laws_test {

constexpr double kPi = std::numbers::pi;

Contact<double> StillContact(double overlap, double r_star) {
  Contact<double> c{};
  c.normal = {1, 0, 0};
  c.overlap = overlap;
  c.r_star = r_star;
  c.root_m_star = 1e-5;
  c.root_i_star = 1e-8;
  return c;
}

double ForceOf(const ContactModels& models, const PairConstants& p, const Contact<double>& c) {
  const ContactArea<double> area = MakeContactArea(c);
  switch (models.adhesion) {
    case Adhesion::kNone:
      return NoAdhesion::Force(p, c, area).total;
    case Adhesion::kDmt:
      return DmtAdhesion::Force(p, c, area).total;
    case Adhesion::kJkr:
      return JkrAdhesion::Force(p, c, area).total;
  }
  return 0;
}

TEST(PairConstants, EqualSurfacesBehaveAsTheirMaterial) {
  Material m = testing::Glass();
  m.surface_energy = 2e-4;
  const PairConstants pair = MakePairConstants(m, m, {.adhesion = Adhesion::kDmt});
  EXPECT_DOUBLE_EQ(pair.sliding_friction, m.sliding_friction);
  EXPECT_DOUBLE_EQ(pair.rolling_friction, m.rolling_friction);
  EXPECT_DOUBLE_EQ(pair.surface_energy, 2 * m.surface_energy);
  EXPECT_DOUBLE_EQ(pair.y_star, m.youngs_modulus / 2 / (1 - 0.09));                // P3
  EXPECT_DOUBLE_EQ(pair.shear_stiffness / 8, m.youngs_modulus / (4 * 1.7 * 1.3));  // P4
}

// Two materials that differ in everything, so that no mean can stand for another (P3 to P6).
TEST(PairConstants, UnequalMaterialsMixByTheirOwnMeans) {
  Material a = testing::Glass(), b = a;
  a.youngs_modulus = 1e7, b.youngs_modulus = 3e7;
  a.poisson_ratio = 0.3, b.poisson_ratio = 0.2;
  a.restitution = 0.9, b.restitution = 0.5;
  a.sliding_friction = 0.2, b.sliding_friction = 0.6;
  a.rolling_friction = 0.1, b.rolling_friction = 0.3;
  a.rolling_damping = 0.2, b.rolling_damping = 0.6;
  a.surface_energy = 2e-4, b.surface_energy = 8e-4;
  a.hamaker_constant = 2e-19, b.hamaker_constant = 6e-19;
  const ContactModels models{.adhesion = Adhesion::kDmt};
  const PairConstants pair = MakePairConstants(a, b, models);
  EXPECT_DOUBLE_EQ(1 / pair.y_star, (1 - 0.09) / 1e7 + (1 - 0.04) / 3e7);
  EXPECT_DOUBLE_EQ(8 / pair.shear_stiffness, 2 * (2 - 0.3) * 1.3 / 1e7 + 2 * (2 - 0.2) * 1.2 / 3e7);
  EXPECT_DOUBLE_EQ(pair.sliding_friction, 2 * 0.2 * 0.6 / 0.8);
  EXPECT_DOUBLE_EQ(pair.rolling_friction, 2 * 0.1 * 0.3 / 0.4);
  EXPECT_DOUBLE_EQ(pair.surface_energy, 2 * std::sqrt(2e-4 * 8e-4));
  EXPECT_DOUBLE_EQ(6 * pair.hamaker, (2e-19 + 6e-19) / 2);
  EXPECT_DOUBLE_EQ(pair.rolling_damping / std::sqrt(pair.rolling_stiffness),
                   2 * 2 * 0.2 * 0.6 / 0.8);
  // Damping goes by β = −ln e / √(ln² e + π²), at e = 2 · 0.9 · 0.5 / 1.4 (N2, N4).
  const double log_e = std::log(2 * 0.9 * 0.5 / 1.4);
  const double beta = -log_e / std::hypot(log_e, std::numbers::pi);
  EXPECT_NEAR(pair.tangential_damping / std::sqrt(pair.shear_stiffness),
              2 * std::sqrt(5.0 / 6.0) * beta, 1e-12);
  const PairConstants reversed = MakePairConstants(b, a, models);
  EXPECT_DOUBLE_EQ(reversed.y_star, pair.y_star);
  EXPECT_DOUBLE_EQ(reversed.shear_stiffness, pair.shear_stiffness);
  EXPECT_DOUBLE_EQ(reversed.normal_damping, pair.normal_damping);
  EXPECT_DOUBLE_EQ(reversed.pull_off, pair.pull_off);
}

TEST(PairConstants, OneFrictionlessOrInertSurfaceIsEnough) {
  Material a = testing::Glass(), b = a;
  a.surface_energy = b.surface_energy = 1e-3;
  b.sliding_friction = b.rolling_friction = b.surface_energy = 0;
  const PairConstants pair = MakePairConstants(a, b, {.adhesion = Adhesion::kDmt});
  EXPECT_EQ(pair.sliding_friction, 0);
  EXPECT_EQ(pair.rolling_friction, 0);
  EXPECT_EQ(pair.pull_off, 0);
  EXPECT_EQ(pair.adhesion_gap, 0);
}

// From the literature; six digits are given.
TEST(Rayleigh, FractionsOfKnownStepsAreThese) {
  const auto percent = [](double d, double rho, double y, double dt) {
    return 100 * dt /
           RayleighTime({.density = rho, .youngs_modulus = y, .poisson_ratio = 0.3}, d / 2);
  };
  EXPECT_NEAR(percent(1e-4, 2600, 5e4, 5e-7), 0.801221, 1e-6);
  EXPECT_NEAR(percent(5e-3, 2000, 1e6, 1e-5), 1.63418, 1e-5);
  EXPECT_NEAR(percent(1e-2, 1200, 8e6, 5e-5), 14.9179, 1e-4);
}

TEST(Dmt, PullIsThePlateauThenFadesThenEnds) {
  Material m = testing::Glass();
  m.surface_energy = 2e-4;
  const ContactModels models{.adhesion = Adhesion::kDmt};
  const PairConstants p = MakePairConstants(m, m, models);
  const double r_star = 50e-6, pull = 2 * kPi * 4e-4 * r_star;
  const double start = std::sqrt(m.hamaker_constant * r_star / (6 * pull));  // -δ₀ (A2)
  EXPECT_NEAR(p.plateau_gap, start, 1e-12 * start);
  EXPECT_NEAR(p.adhesion_gap, start / std::sqrt(0.1), 1e-12 * start);
  const auto at = [&](double gap) { return ForceOf(models, p, StillContact(-gap, r_star)); };
  EXPECT_NEAR(at(0.5 * start), -pull, 1e-12 * pull);
  EXPECT_NEAR(at(2 * start), -pull / 4, 1e-12 * pull);  // 1/gap²
}

// The root is checked against the quartic itself, and against bisection for being the largest.
TEST(Jkr, ContactRadiusIsTheLargestRootOfTheQuartic) {
  for (const double r_star : {1e-6, 5e-5, 1e-3, 0.1}) {
    for (const double b_share : {1e-9, 1e-3, 1.0, 1e3}) {
      const double delta = 1e-3 * r_star, rd = r_star * delta;
      const double b = b_share * std::pow(rd, 1.5);  // B against a³ without adhesion
      const double t = JkrAdhesion::CubeRootBound(r_star);
      EXPECT_NEAR(t / std::cbrt(r_star), 1, 0.06);
      const double bound = std::cbrt(b) * (t / std::cbrt(r_star)) * (t / std::cbrt(r_star));
      const double a = JkrAdhesion::AreaRadius(rd, std::sqrt(b), bound);
      const auto residual = [&](double x) { return (x * x - rd) * (x * x - rd) - b * x; };
      double low = a, high = 2 * (std::sqrt(rd) + std::cbrt(b));
      EXPECT_GT(residual(high), 0);
      for (int k = 0; k < 200; ++k) {  // above the largest root the quartic is positive
        const double middle = (low + high) / 2;
        (residual(middle) > 0 ? high : low) = middle;
      }
      // Near a double root the quartic says little: the residual's own round-off is 1e-16 rd².
      EXPECT_NEAR(a / high, 1, 1e-7) << r_star << ' ' << b_share;
    }
  }
}

TEST(Jkr, ForceVanishesAtTheKnownContact) {
  Material m = testing::Glass();
  m.youngs_modulus = 1e4;
  m.surface_energy = 2e-4;
  const ContactModels models{.adhesion = Adhesion::kJkr};
  const PairConstants p = MakePairConstants(m, m, models);
  const double r = 50e-6, gamma = 4e-4;
  const double a = std::cbrt(9 * kPi * gamma * r * r / (2 * p.y_star));
  const double overlap = (a * a - std::sqrt(2 * kPi * gamma * r * r / p.y_star * a)) / r;  // A4
  const double pull = kPi * gamma * r;
  EXPECT_NEAR(ForceOf(models, p, StillContact(overlap, r)), 0, 1e-9 * pull);
  // The simplified law ends at δ = 0 with a³ = 2πγR²/Y*, where the force is -(4/3) πγR.
  EXPECT_NEAR(ForceOf(models, p, StillContact(1e-9 * overlap, r)), -4.0 / 3 * pull, 1e-4 * pull);
  // Friction's limit is measured from the pull-off of full JKR (A5).
  const Contact<double> c = StillContact(overlap, r);
  EXPECT_NEAR(JkrAdhesion::Force(p, c, MakeContactArea(c)).friction, 3 * pull, 1e-9 * pull);
  // The rolling torque's limit is that of the net force, or is measured likewise (A6).
  EXPECT_NEAR(JkrAdhesion::Force(p, c, MakeContactArea(c)).rolling, 0, 1e-9 * pull);
  const PairConstants other = MakePairConstants(
      m, m, {.adhesion = Adhesion::kJkr, .jkr_rolling_limit = JkrRollingLimit::kFromPullOff});
  EXPECT_NEAR(JkrAdhesion::Force(other, c, MakeContactArea(c)).rolling, 3 * pull, 1e-9 * pull);
}

// Steady sliding by 1000 steps: the force is the limit either way, a spring that is kept is as long
// as the way (A7), one that is shortened has the length of its limit (T2).
TEST(Jkr, KeptSpringsGrowWhileTheySlide) {
  Material m = testing::Glass();
  m.surface_energy = 2e-2;
  for (const JkrSlidingSpring form : {JkrSlidingSpring::kKept, JkrSlidingSpring::kShortened}) {
    const PairConstants p =
        MakePairConstants(m, m, {.adhesion = Adhesion::kJkr, .jkr_sliding_spring = form});
    Contact<double> c = StillContact(1e-6, 1e-3);
    const double speed = 1, dt = 1e-6;
    c.sliding = {0, speed, 0};
    History<double> history{};
    Response<double> response{};
    for (int step = 0; step < 1000; ++step) {
      response = Respond<Laws<JkrAdhesion, TotalForceLimit, NoRolling>>(p, c, dt, history);
    }
    const ContactArea<double> area = MakeContactArea(c);
    const double limit = m.sliding_friction * JkrAdhesion::Force(p, c, area).friction;
    EXPECT_NEAR(response.force.y / -limit, 1, 1e-12);
    if (form == JkrSlidingSpring::kKept) {
      EXPECT_NEAR(history.spring.y, 1000 * speed * dt, 1e-12);
    } else {
      const double dashpot = p.tangential_damping * area.root_s * c.root_m_star * speed;
      EXPECT_NEAR(history.spring.y / ((limit - dashpot) / (p.shear_stiffness * area.s)), 1, 1e-9);
    }
  }
}

}  // namespace laws_test
}  // namespace talus::engine
