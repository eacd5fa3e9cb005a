// Angles of repose that rigs read off their heaps.
#include "experiments/rigs/phased/repose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus::rigs {
namespace repose_test {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPlate = 0.014;  // diameter [m]
constexpr double kGrain = 0.5e-3;

// Grains on a fine lattice that fill a cone as wide as the plate: those at its surface touch it,
// and the plate cuts the lowest in halves.
std::vector<engine::Particle> Cone(double angle) {
  constexpr double kSpacing = 0.15e-3;
  constexpr int kReach = 47;  // over the plate
  const double radius = kGrain / 2;
  const double height = kPlate / 2 * std::tan(angle);
  std::vector<engine::Particle> grains;
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      const double x = kSpacing * i;
      const double y = kSpacing * j;
      const double surface = height * (1 - std::hypot(x, y) / (kPlate / 2));
      for (double z = 0; z + radius / std::cos(angle) <= surface; z += kSpacing) {
        engine::Particle& grain = grains.emplace_back();
        grain.position = {x, y, z};
        grain.radius = radius;
      }
    }
  }
  return grains;
}

// The lattice's steps are 0.15 mm on slopes that are 7 mm wide: 1.2 degrees.
TEST(Repose, OfAConeEveryMethodIsItsAngle) {
  for (const double angle : {25 * kDegree, 40 * kDegree}) {
    const auto readings =
        ReposeReadings(Cone(angle), {.diameter = kPlate, .grain_diameter = kGrain});
    ASSERT_EQ(readings.size(), 5U);
    for (const Reading& reading : readings) {
      ASSERT_EQ(reading.undefined, "") << MetricName(reading.observable);
      if (reading.observable == Observable::kStaticCohesiveIndex) {
        EXPECT_LT(reading.value, 0.1);  // it is its triangle, but for the steps
      } else {
        EXPECT_NEAR(reading.value, angle / kDegree, 1.2) << MetricName(reading.observable);
      }
    }
  }
}

// It was "one grain high", and its index "the heap is empty".
TEST(Repose, OfALayerThatDoesNotFillTheRimNothingIsRead) {
  std::vector<engine::Particle> layer(3);
  for (engine::Particle& grain : layer) {
    grain.position = {0, 0, -2 * kGrain};
    grain.radius = kGrain / 2;
  }
  for (const Reading& reading :
       ReposeReadings(layer, {.diameter = kPlate, .grain_diameter = kGrain})) {
    EXPECT_EQ(reading.undefined, "nothing stands above the rim") << MetricName(reading.observable);
  }
}

// A few grains that stayed on the plate had one of 72°.
TEST(Repose, ALayerOfSingleGrainsHasNoAngle) {
  std::vector<engine::Particle> layer;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      layer.push_back({.radius = kGrain / 2, .position = {i * kGrain, j * kGrain, kGrain / 2}});
    }
  }
  const RoundPlate plate{.diameter = kPlate, .grain_diameter = kGrain};
  for (const Reading& reading : ReposeReadings(layer, plate)) {
    if (reading.observable == Observable::kStaticCohesiveIndex) continue;
    EXPECT_EQ(reading.undefined, "the heap is one grain high");
  }
  layer.push_back({.radius = kGrain / 2, .position = {0, 0, 2 * kGrain}});
  EXPECT_EQ(ReposeReadings(layer, plate)[3].undefined, "");
}

TEST(Repose, OfNoHeapThereIsNoAngle) {
  for (const Reading& reading :
       ReposeReadings({}, {.diameter = kPlate, .grain_diameter = kGrain})) {
    EXPECT_THAT(reading.undefined, testing::HasSubstr("the heap is empty"));
  }
}

}  // namespace repose_test
}  // namespace talus::rigs
