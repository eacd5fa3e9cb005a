// How fast and under which pressure powder is sheared, of grains whose motion is known.
#include "experiments/rigs/phased/regime.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus::rigs {
namespace regime_test {

constexpr double kDiameter = 1e-3;  // [m]
constexpr double kDensity = 2000;   // [kg/m³]
constexpr double kForce = 1e-4;     // of each contact, repulsive [N]
// Grains on a cubic lattice fill π/6 of it; the volume is taken at a solid fraction of 0.6.
const double kPressure = kForce / (kDiameter * kDiameter * std::numbers::pi / 6 / 0.6);

// Bins are an eighth of a decade wide: half of one is 15 %.
constexpr double kBin = 0.16;

struct Lattice {
  std::vector<engine::Particle> particles;
  std::vector<engine::ContactInfo> contacts;

  // 12³ grains that move by `velocity` of their place.
  template <class Velocity>
  explicit Lattice(Velocity velocity) {
    constexpr int kSide = 12;
    for (int z = 0; z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const base::Vec3 place = kDiameter * base::Vec3{x + 0.5, y + 0.5, z + 0.5};
          const auto id = static_cast<std::int64_t>(particles.size());
          particles.push_back(
              {.id = id, .radius = kDiameter / 2, .position = place, .velocity = velocity(place)});
          if (x > 0) Touch(id - 1, id, {1, 0, 0});
          if (y > 0) Touch(id - kSide, id, {0, 1, 0});
          if (z > 0) Touch(id - kSide * kSide, id, {0, 0, 1});
        }
      }
    }
  }
  void Touch(std::int64_t first, std::int64_t second, const base::Vec3& normal) {
    contacts.push_back(
        {.first = first, .second = second, .normal = normal, .force = -kForce * normal});
  }
  std::optional<Regime> Seen() const {
    RegimeMemory memory;
    LookAtFlow(
        {.particles = particles, .contacts = contacts, .diameter = kDiameter, .density = kDensity},
        memory);
    return RegimeOf(memory);
  }
};

TEST(Regime, OfSimpleShearIsItsRateAndTheContactsPressure) {
  constexpr double kRate = 5;  // [1/s]
  const auto regime = Lattice([](const base::Vec3& x) {
                        return base::Vec3{kRate * x.z, 0, 0};
                      }).Seen();
  ASSERT_TRUE(regime.has_value());
  EXPECT_NEAR(regime->shear_rate[1], kRate, kBin * kRate);
  // Cells at the surface have fewer contacts: a sixth less in each of three directions at most.
  EXPECT_NEAR(regime->pressure[1], kPressure, 0.35 * kPressure);
  const double number = kRate * kDiameter * std::sqrt(kDensity / regime->pressure[1]);
  EXPECT_NEAR(regime->inertial_number[1], number, 2 * kBin * number);
}

// A turning or a growing body is not sheared.
TEST(Regime, RigidRotationAndEvenGrowthAreNoShear) {
  for (const double turns : {1.0, 0.0}) {
    const auto regime = Lattice([&](const base::Vec3& x) {
                          return turns > 0 ? base::Vec3{-turns * x.y, turns * x.x, 0} : 2.0 * x;
                        }).Seen();
    EXPECT_TRUE(!regime || regime->shear_rate[2] < 1e-9);  // rounding
  }
}

TEST(Regime, GrainsThatFlyHaveNone) {
  Lattice lattice([](const base::Vec3& x) { return base::Vec3{x.z, 0, 0}; });
  lattice.contacts.clear();
  EXPECT_FALSE(lattice.Seen().has_value());
}

// Half of the work at 1, half at 100: the quantiles stand on either side.
TEST(Regime, QuantilesAreOfTheWork) {
  LogHistogram seen;
  seen.Add(1, 1);
  seen.Add(100, 0.5);
  seen.Add(100, 0.5);
  seen.Add(0, 7);  // neither zero nor what weighs nothing counts
  seen.Add(1e4, 0);
  EXPECT_NEAR(seen.Quantile(0.25), 1, kBin + 0.02);
  EXPECT_NEAR(seen.Quantile(0.75), 100, 100 * (kBin + 0.02));
  EXPECT_TRUE(std::isnan(LogHistogram{}.Quantile(0.5)));
}

}  // namespace regime_test
}  // namespace talus::rigs
