// A spread layer against behaviours that are known of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "experiments/rigs/spreading/layer.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace spreading_test {

using ::testing::HasSubstr;

// A strip six grains wide.
Case Spread(double gap, double speed = 0.2) {
  Case c = CaseOf(RigKind::kSpreading, 0.5, 0.1, 1.3e-3);
  c.rig.spreading = {.gap = gap, .speed = speed, .length = 0.024, .width = 0.006, .feed = 0.01};
  return c;
}

// The largest grain is 1.1 mm. Over ten seeds the coverage is 0.022 ± 0.017, 0.055 at most.
TEST(Spreading, BelowAGapOfOneGrainNothingIsSpread) {
  const Case c = Spread(0.7e-3);
  const auto rig = Ran(c);
  EXPECT_LT(Value(c, *rig, "layer_mass_kg"), 0.02 * c.powder.mass);
  EXPECT_LT(Value(c, *rig, "coverage"), 0.1);
  EXPECT_GT(Value(c, *rig, "mass_ahead_kg"), 0.9 * c.powder.mass);
}

// A gap of one and a half grains, two and a half, four: seen up to 0.384, where the poured bed has
// 0.58.
TEST(Spreading, PackingGrowsWithTheGapTowardsThatOfTheBulk) {
  double last = 0.05;
  for (const double gap : {1.5e-3, 2.5e-3, 4e-3}) {
    Case c = Spread(gap);
    c.powder.mass = 2.2e-3;
    const auto rig = Ran(c);
    const double packing = Value(c, *rig, "packing_fraction");
    EXPECT_GT(packing, last) << gap;
    EXPECT_LT(packing, 0.58);
    last = packing;
  }
  EXPECT_GT(last, 0.35);
}

TEST(Spreading, AFasterBladeLeavesAThinnerLayer) {
  const Case slow = Spread(2.5e-3, 0.05);
  const Case fast = Spread(2.5e-3, 0.6);
  const auto after_slow = Ran(slow);
  const auto after_fast = Ran(fast);
  EXPECT_LT(Value(fast, *after_fast, "thickness_m"), 0.9 * Value(slow, *after_slow, "thickness_m"));
  EXPECT_LT(Value(fast, *after_fast, "layer_mass_kg"),
            0.9 * Value(slow, *after_slow, "layer_mass_kg"));
}

// What is read off the middle is the packing fraction's mass by another name; the whole plate's,
// its thin ends included, is no more than a fifth from it.
TEST(Spreading, MassPerAreaIsThatOfTheMiddleOfTheLayer) {
  const Case c = Spread(2.5e-3);
  const auto rig = Ran(c);
  const double mass = Value(c, *rig, "mass_per_area_kg_per_m2");
  EXPECT_NEAR(mass, Value(c, *rig, "packing_fraction") * 2.5e-3 * c.powder.material.density,
              1e-12 * mass);
  EXPECT_NEAR(mass, Value(c, *rig, "layer_mass_kg") / (0.024 * 0.006), 0.2 * mass);
}

// Pull-off 1.5 π γ R = 100 grain weights: lumps that do not pass a gap of two grains.
TEST(Spreading, CohesionLowersTheCoverage) {
  const Case dry = Spread(2e-3);
  Case sticky = dry;
  sticky.models.adhesion = engine::Adhesion::kDmt;
  sticky.powder.material.surface_energy = 0.4;
  const auto after_dry = Ran(dry);
  const auto after_sticky = Ran(sticky);
  EXPECT_LT(Value(sticky, *after_sticky, "coverage"), Value(dry, *after_dry, "coverage") - 0.05);
}

// The strip with a heap that is no higher than the roller. Turning a roller against rolling, at the
// speed of its path, moves its lowest line twice as fast as it goes.
Case SpreadBy(Spreader spreader) {
  Case c = Spread(2.5e-3);
  c.rig.spreading.feed = 0.016;
  c.rig.spreading.spreader = spreader;
  if (spreader == Spreader::kRoller) {
    c.rig.spreading.roller_diameter = 0.012;
    c.rig.spreading.turning = 33;
  }
  if (spreader == Spreader::kComb) {
    c.rig.spreading.teeth = 2;
    c.rig.spreading.slot = 2e-3;
  }
  return c;
}

// What a blade leaves, spread once for all tests that compare with it.
const Rig& Bladed() {
  static const std::unique_ptr<Rig> kRig = Ran(SpreadBy(Spreader::kBlade));
  return *kRig;
}

// A roller presses powder into its nip, a blade scrapes it off: seen 0.344 and 0.280, and 0.343
// with a roller that does not turn.
TEST(Spreading, ARollerLeavesADenserLayerThanABlade) {
  const Case blade = SpreadBy(Spreader::kBlade);
  const Case roller = SpreadBy(Spreader::kRoller);
  EXPECT_GT(Value(roller, *Ran(roller), "packing_fraction"),
            1.1 * Value(blade, Bladed(), "packing_fraction"));
}

// Through the slots of a comb more passes than below a blade: seen 0.38 and 0.24 g.
TEST(Spreading, ACombLeavesMoreThanABlade) {
  const Case blade = SpreadBy(Spreader::kBlade);
  const Case comb = SpreadBy(Spreader::kComb);
  EXPECT_GT(Value(comb, *Ran(comb), "layer_mass_kg"),
            1.2 * Value(blade, Bladed(), "layer_mass_kg"));
}

// Grains on a plate are swept along; those of a bed hold what comes to lie on them. Seen 0.395 and
// 0.280. The bed is struck off: none of its grains stands above its level at first.
TEST(Spreading, ABedOfPowderHoldsMoreThanABarePlate) {
  const Case plate = SpreadBy(Spreader::kBlade);
  Case bed = plate;
  bed.rig.spreading.bed = 4e-3;
  const auto rig = Ran(bed);
  EXPECT_GT(Value(bed, *rig, "packing_fraction"), 1.1 * Value(plate, Bladed(), "packing_fraction"));
  const auto result = nlohmann::json::parse(rig->ResultText(rig->Grains(), {}));
  EXPECT_EQ(result["counts"]["left"], 0);
  EXPECT_GT(result["counts"]["bed"], 300);
}

TEST(Spreading, APictureFromAboveShowsThePlateAsLongAsItIs) {
  const Rig& rig = Bladed();
  const auto picture = rig.FromAbove(rig.Grains());
  ASSERT_TRUE(picture.has_value());
  // A pixel is a twentieth of the mean diameter by volume, which is 1 mm within 2 %.
  EXPECT_NEAR(picture->width, 24 * 20, 10);
  EXPECT_NEAR(picture->height, 6 * 20, 3);
  const auto bare = std::count(picture->pixels.begin(), picture->pixels.end(), 255);
  EXPECT_GT(bare, 0);
  EXPECT_LT(bare, 0.4 * static_cast<double>(picture->pixels.size()));
}

TEST(Spreading, KeysOfAnotherSpreaderAreRefused) {
  const std::string powder = R"({"powder": {"material": {"density": 2500},
                                "sizes": {"kind": "mono", "diameter": "0.2 mm"},
                                "mass": "0.01 g"}, "rig": {"kind": "spreading", )";
  EXPECT_THAT(ErrorOf((powder + R"("teeth": 3}})").c_str()), HasSubstr("is a comb's"));
  EXPECT_THAT(ErrorOf((powder + R"("spreader": "comb", "turning": 3}})").c_str()),
              HasSubstr("is a roller's"));
  EXPECT_THAT(ErrorOf((powder + R"("spreader": "comb", "slot": "1 mm"}})").c_str()),
              HasSubstr("leaves nothing of the teeth"));
}

// One grain of diameter d in the middle of a square of edge 2d: π/16 of it is covered, and the mean
// height is that of half an ellipsoid with its cylinder, (π d²/4)(d/2 + d/3)/(4 d²).
TEST(Layer, OfOneGrainIsItsDisc) {
  const double d = 1e-3;
  const engine::Particle grain{.radius = d / 2, .position = {0.01, 0, d / 2}};
  const LayerWindow window{.from = 0.01 - d, .to = 0.01 + d, .half_width = d};
  const Layer layer = LayerOf({&grain, 1}, window, 0.05 * d);  // a fine raster
  EXPECT_NEAR(layer.coverage, std::numbers::pi / 16, 2e-3);
  EXPECT_NEAR(layer.thickness, std::numbers::pi / 16 * d * (1.0 / 2 + 1.0 / 3), 2e-3 * d);
  EXPECT_TRUE(window.Holds(grain));
  EXPECT_EQ(LayerOf({}, window, d).coverage, 0);
}

TEST(Spreading, TheLayerIsReadAwayFromEndsAndSides) {
  const Case c = Spread(2.5e-3);
  const auto rig = Ran(c);
  const double from = 0.15 * 0.024, to = 0.85 * 0.024, half_width = 0.003 - 1.1e-3;
  double mass = 0;
  double volume[3] = {}, moment[3] = {};
  for (const engine::Particle& p : rig->Grains()) {
    const bool is_seen = p.position.x >= from && p.position.x < to &&
                         std::abs(p.position.y) < half_width && p.position.z > 0;
    if (!is_seen) continue;
    const double cube = std::pow(p.radius, 3);
    const auto third = static_cast<std::size_t>(3 * (p.position.x - from) / (to - from));
    mass += kDensity * 4 / 3 * std::numbers::pi * cube;
    volume[third] += cube;
    moment[third] += cube * p.radius;
  }
  const double area = (to - from) * 2 * half_width;
  EXPECT_NEAR(Value(c, *rig, "mass_per_area_kg_per_m2"), mass / area, 1e-9 * mass / area);
  EXPECT_NEAR(Value(c, *rig, "size_drift"), moment[2] / volume[2] / (moment[0] / volume[0]), 1e-9);
}

}  // namespace spreading_test
}  // namespace talus::rigs
