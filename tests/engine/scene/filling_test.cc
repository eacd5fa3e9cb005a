#include "engine/scene/filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "engine/scene/size_distribution.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace filling_test {

struct Load {
  std::vector<double> radii;
  FillRequest request;
};

Load Mono(std::size_t n) {
  return {.radii = std::vector<double>(n, 0.5e-3),
          .request = {.region = {.diameter = 0.01}, .seed = 7}};
}
Load Poly() {
  const SizeDistribution sizes{.kind = SizeKind::kLogNormal, .median = 1e-3, .sigma = 0.3};
  Load load{.radii = DrawDiameters(SizeCurve(sizes), 4e-7),
            .request = {.region = {.diameter = 0.01}, .seed = 3}};
  for (double& r : load.radii) r /= 2;
  load.radii = Shuffled(load.radii, 3);
  return load;
}
Load Box() {
  return {.radii = std::vector<double>(800, 0.5e-3),
          .request = {.region = {.shape = RegionShape::kBox,
                                 .base = {1, 2, 3},
                                 .width_x = 0.012,
                                 .width_y = 0.008,
                                 .height = 0.009}}};
}

// The largest overlap of any pair and with the region, over the radius: the O(n²) answer.
double BruteForceOverlap(const Load& load, const Filling& filling) {
  const FillRegion& region = load.request.region;
  double largest = 0;
  for (std::size_t i = 0; i < load.radii.size(); ++i) {
    const double r = load.radii[i];
    const Vec3 x = filling.positions[i] - region.base;
    largest = std::max(largest, (r - x.z) / r);
    if (region.height) largest = std::max(largest, (x.z + r - *region.height) / r);
    if (region.shape == RegionShape::kCylinder) {
      largest = std::max(largest, (std::hypot(x.x, x.y) + r - *region.diameter / 2) / r);
    } else {
      largest = std::max(largest, (std::abs(x.x) + r - *region.width_x / 2) / r);
      largest = std::max(largest, (std::abs(x.y) + r - *region.width_y / 2) / r);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = Norm(filling.positions[i] - filling.positions[j]);
      const double overlap = r + load.radii[j] - distance;
      largest = std::max(largest, overlap / std::min(r, load.radii[j]));
    }
  }
  return largest;
}

class Fills : public ::testing::TestWithParam<Load (*)()> {};

TEST_P(Fills, NothingOverlapsBeyondTheLimitOrLeavesTheRegion) {
  const Load load = GetParam()();
  const Filling filling = Fill(load.radii, load.request);
  ASSERT_EQ(filling.positions.size(), load.radii.size());
  EXPECT_LT(filling.num_sweeps, load.request.max_sweeps);
  EXPECT_LE(filling.max_overlap, load.request.max_overlap);
  // Round-off of positions of the order of a metre beside radii of half a millimetre.
  EXPECT_LE(BruteForceOverlap(load, filling), load.request.max_overlap + 1e-11);
}
INSTANTIATE_TEST_SUITE_P(Shapes, Fills,
                         ::testing::Values(
                             +[] { return Mono(1500); }, &Poly, &Box));

TEST(Filling, IsAsDenseAsAskedAboveTheFlatBottom) {
  const Load load = Mono(4000);
  const Filling filling = Fill(load.radii, load.request);
  double volume = 0;  // of what lies between the first and the last tenth of the height
  for (std::size_t i = 0; i < load.radii.size(); ++i) {
    const double z = filling.positions[i].z / filling.height;
    if (z > 0.1 && z < 0.9) volume += 4.0 / 3 * std::numbers::pi * std::pow(load.radii[i], 3);
  }
  const double fraction = volume / (0.8 * filling.height * load.request.region.Area());
  // the the sweeps let the top expand: 0.55 becomes 0.53 or so. A
  // loose lattice, from which the grains would have to fall, has 0.3.
  EXPECT_GT(fraction, 0.50);
  EXPECT_LT(fraction, 0.58);
}

TEST(Filling, SameSeedSameBitsOtherSeedOtherPlaces) {
  Load load = Mono(500);
  const Filling a = Fill(load.radii, load.request);
  EXPECT_EQ(a.positions, Fill(load.radii, load.request).positions);
  load.request.seed = 8;
  EXPECT_NE(a.positions, Fill(load.radii, load.request).positions);
}

TEST(Filling, ARegionThatIsTooSmallEndsAtTheCapAndSaysSo) {
  Load load = Mono(1500);
  load.request.region.height = 5e-3;  // the grains' own volume fills it to 2 times
  load.request.max_sweeps = 50;
  const Filling filling = Fill(load.radii, load.request);
  EXPECT_EQ(filling.num_sweeps, 50);
  EXPECT_GT(filling.max_overlap, load.request.max_overlap);
}

TEST(Filling, WhatCannotBeIsNamed) {
  const auto error_of = [](const std::function<void(Load&)>& change, Load load) {
    change(load);
    return ErrorIn([&] { Fill(load.radii, load.request); });
  };
  const auto is_refused = [&](const std::string& key, const std::function<void(Load&)>& change) {
    EXPECT_EQ(error_of(change, Mono(10)).find(key), 0u) << key << " " << error_of(change, Mono(10));
  };
  is_refused("solid_fraction", [](Load& load) { load.request.solid_fraction = 0; });
  is_refused("solid_fraction", [](Load& load) { load.request.solid_fraction = 0.7; });
  is_refused("max_overlap", [](Load& load) { load.request.max_overlap = NAN; });
  is_refused("max_sweeps", [](Load& load) { load.request.max_sweeps = 0; });
  is_refused("region.diameter", [](Load& load) { load.request.region.diameter = {}; });
  is_refused("radii[3]", [](Load& load) { load.radii[3] = 0; });
  is_refused("radii[4]", [](Load& load) { load.radii[4] = NAN; });
  is_refused("radii[5]", [](Load& load) { load.radii[5] = 5.1e-3; });
  is_refused("radii[0]", [](Load& load) { load.request.region.height = 0.9e-3; });
  EXPECT_EQ(error_of([](Load& load) { load.radii[5] = 5e-3; }, Mono(10)), "");
}

TEST(Shuffled, KeepsTheValuesAndChangesTheirOrder) {
  std::vector<double> values(100);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  std::vector<double> shuffled = Shuffled(values, 1);
  EXPECT_NE(shuffled, values);
  EXPECT_NE(shuffled, Shuffled(values, 2));
  std::sort(shuffled.begin(), shuffled.end());
  EXPECT_EQ(shuffled, values);
}

}  // namespace filling_test
}  // namespace talus::engine
