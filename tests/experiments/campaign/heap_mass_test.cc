// A photographed heap cannot weigh more than was filled in.
#include "experiments/campaign/record/heap_mass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "experiments/campaign/answer/alarm.h"

namespace talus::campaign {
namespace heap_mass_test {

using ::testing::HasSubstr;

// A cone as high as its base is wide, on a plate of 10 mm; 20 px a millimetre.
imaging::Profile Cone() {
  imaging::Profile profile{
      .image = {.width = 240, .height = 230, .pixels = std::vector<std::uint8_t>(240 * 230, 255)},
      .frame = {.width = 240,
                .height = 230,
                .pixel_size = 5e-5,
                .center_x = 120,
                .baseline = 210,
                .plate_diameter = 0.01}};
  for (int y = 10; y < 210; ++y) {
    const double half = 0.5 * (y + 0.5 - 10);
    for (int x = 0; x < 240; ++x) {
      if (std::abs(x + 0.5 - 120) < half) profile.image.pixels[y * 240 + x] = 0;
    }
  }
  return profile;
}

rigs::Case Filled(double mass) {
  rigs::Case rig_case;
  rig_case.powder.material.density = 2500;
  rig_case.powder.mass = mass;
  rig_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 1e-5};
  return rig_case;
}

// π/12 of its height cubed, within a pixel along its sides.
constexpr double kVolume = std::numbers::pi / 12 * 1e-6;

TEST(HeapMass, AConeHasItsVolume) { EXPECT_NEAR(VolumeOfRevolution(Cone()) / kVolume, 1, 0.01); }

// Half of its grains are wider than 1 mm, so that half a millimetre of its 10 is air.
TEST(HeapMass, TheOutlinePassesHalfAGrainAboveThePowder) {
  EXPECT_NEAR(VolumeOfRevolution(Cone(), 0.5e-3) / kVolume, std::pow(0.95, 3), 0.01);
  const double least = 0.4 * 2500 * kVolume;
  rigs::Case coarse = Filled(0.9 * least);
  coarse.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 1e-3};
  EXPECT_FALSE(MoreThanFilled(coarse, Cone()).has_value());
  coarse.powder.sizes.diameter = 1e-4;
  EXPECT_TRUE(MoreThanFilled(coarse, Cone()).has_value());
}

TEST(HeapMass, AHeapOfMoreThanWasFilledInIsDoubted) {
  const double least = 0.4 * 2500 * kVolume;  // 0.26 g
  EXPECT_FALSE(MoreThanFilled(Filled(1.05 * least), Cone()).has_value());
  const auto doubt = MoreThanFilled(Filled(0.5 * least), Cone());
  ASSERT_TRUE(doubt.has_value());
  EXPECT_EQ(PhotographAlarm(*doubt, "heap").kind, AlarmKind::kMoreThanFilled);
  EXPECT_NEAR(doubt->value, 2, 0.03);
  EXPECT_THAT(doubt->text, HasSubstr("would weigh 0.26 g"));
  // The picture of a drum is no heap on a plate.
  rigs::Case drum = Filled(0.5 * least);
  drum.rig.kind = rigs::RigKind::kDrum;
  EXPECT_FALSE(MoreThanFilled(drum, Cone()).has_value());
}

}  // namespace heap_mass_test
}  // namespace talus::campaign
