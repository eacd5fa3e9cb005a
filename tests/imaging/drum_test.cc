#include "imaging/drums/drum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "imaging/drums/drum_circle.h"
#include "imaging/drums/drum_overlay.h"
#include "imaging/formats/images/image_file.h"
#include "tests/imaging/drum_photograph.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace drum_test {

using testing::AllOf;
using testing::HasSubstr;

// The share of a disc below a chord that is `depth` radii of `radius` from its centre.
double Segment(double depth) {
  return (std::acos(depth) - depth * std::sqrt(1 - depth * depth)) / std::numbers::pi;
}

class DrumAngles : public testing::TestWithParam<double> {};

// A line through some 70 columns, each known to a tenth of a pixel: 0.1 degrees. The ring's blur
// moves the circle by less than half a pixel in 140.
TEST_P(DrumAngles, AngleFillCircleAndTurningComeBack) {
  const double angle = GetParam() * kDegree;
  const MeasuredDrum drum = Measure({.angle = angle});
  EXPECT_NEAR(drum.map.circle.center_x, kCenterX, 0.5);
  EXPECT_NEAR(drum.map.circle.center_y, kCenterY, 0.5);
  EXPECT_NEAR(drum.map.circle.radius, kRadius, 0.7);
  EXPECT_NEAR(drum.angle.value / kDegree, std::abs(GetParam()), 0.2);
  EXPECT_EQ(drum.turning, angle > 0 ? Turning::kClockwise : Turning::kCounterClockwise);
  EXPECT_NEAR(drum.surface.fill.value, Segment(0.2), 0.005);
  EXPECT_LT(drum.map.inner_radius, kRadius - 4);  // the ring is left out
  EXPECT_GT(drum.map.inner_radius, kRadius - 8);
}
INSTANTIATE_TEST_SUITE_P(BothWays, DrumAngles, testing::Values(-50, -20, 5, 33, 60));

// The share of the whole disc, the ring's included: of what is seen alone it was 0.130 for 0.142,
// and 0.871 for 0.858, which is what a simulated drum would be filled with.
TEST(Drum, TheFillIsThatOfTheWholeDrum) {
  for (const double depth : {0.6, -0.6}) {
    const MeasuredDrum drum = Measure({.angle = 33 * kDegree, .depth = depth});
    EXPECT_NEAR(drum.surface.fill.value, Segment(depth), 0.005);
  }
}

// Twelve hundred pixels wide, its edges blurred by 4.5 px, as a camera of many pixels has
// them.
TEST(Drum, ALargeBlurredPhotographIsRead) {
  constexpr int kLarge = 1200;
  constexpr double kTimes = kLarge / static_cast<double>(kSide), kBlur = 4.5;
  const auto share_beyond = [](double way) {
    return 0.5 * std::erfc(-way / (kBlur * std::sqrt(2)));
  };
  GrayImage photo{.width = kLarge, .height = kLarge, .pixels = {}};
  for (int y = 0; y < kLarge; ++y) {
    for (int x = 0; x < kLarge; ++x) {
      const double right = x + 0.5 - kTimes * kCenterX, up = kTimes * kCenterY - y - 0.5;
      const double r = std::hypot(right, up);
      const double inside = up < -0.2 * kTimes * kRadius ? 25 : 240;
      const double ring = share_beyond(r - kTimes * (kRadius - 4));
      const double around = share_beyond(r - kTimes * kRadius);
      const double level = inside + (15 - inside) * ring + (170 - 15) * around;
      photo.pixels.push_back(static_cast<std::uint8_t>(level + 0.5));
    }
  }
  const MeasuredDrum drum = MeasureDrum({.photos = {Write("large", photo)}, .diameter = 0.084});
  EXPECT_NEAR(drum.map.circle.center_x, kTimes * kCenterX, 1);
  EXPECT_NEAR(drum.map.circle.center_y, kTimes * kCenterY, 1);
  EXPECT_NEAR(drum.map.circle.radius, kTimes * kRadius, kBlur);
}

// Light 72, ring 14 and surroundings 68, in place of 240, 15 and 170.
// Three means over 5 × 5 pixels: a blur of 2.4 px.
GrayImage Blurred(GrayImage image) {
  for (int pass = 0; pass < 3; ++pass) {
    const GrayImage before = image;
    for (int y = 2; y < image.height - 2; ++y) {
      for (int x = 2; x < image.width - 2; ++x) {
        double sum = 0;
        for (int i = 0; i < 25; ++i) sum += before.at(x + i % 5 - 2, y + i / 5 - 2);
        image.at(x, y) = static_cast<std::uint8_t>(sum / 25 + 0.5);
      }
    }
  }
  return image;
}

// The outer end of a blurred edge was taken for its middle: 1.3 px too wide.
TEST(Drum, ABlurredRingIsAsWideAsASharpOne) {
  GrayImage photo = Draw({});
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {  // a ring of 15 px
      const double r = std::hypot(x + 0.5 - kCenterX, y + 0.5 - kCenterY);
      if (r < kRadius - 3 && r > kRadius - 15) photo.at(x, y) = 15;
    }
  }
  EXPECT_NEAR(FindDrumCircle(photo, "sharp").radius, kRadius, 0.2);
  EXPECT_NEAR(FindDrumCircle(Blurred(photo), "blurred").radius, kRadius, 0.6);
}

// Half of the noise on light counted as powder: 0.007 of the drum.
TEST(Drum, TheCamerasNoiseIsNoPowder) {
  GrayImage photo = Draw({});
  base::Random random(1, 2);
  for (std::uint8_t& level : photo.pixels) {
    const double noisy = level + 5 * random.Normal();
    level = static_cast<std::uint8_t>(std::clamp(noisy, 0.0, 255.0) + 0.5);
  }
  const MeasuredDrum drum = MeasureDrum({.photos = {Write("noisy", photo)}, .diameter = 0.084});
  EXPECT_NEAR(drum.surface.fill.value, Segment(0.2), 0.004);
}

// Dust on the glass or a grain in flight was the surface of its columns: 20 degrees for 30.
TEST(Drum, ASpeckAboveTheBedIsNoSurface) {
  GrayImage photo = Draw({.angle = 30 * kDegree});
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      if (std::hypot(x + 0.5 - (kCenterX + 25), y + 0.5 - (kCenterY - 45)) < 3) photo.at(x, y) = 25;
    }
  }
  const MeasuredDrum drum = MeasureDrum({.photos = {Write("speck", photo)}, .diameter = 0.084});
  EXPECT_NEAR(drum.angle.value / kDegree, 30, 0.2);
  EXPECT_EQ(drum.turning, Turning::kClockwise);
}

// The ring's level was mixed into the powder's: powder that is there in every picture stood at 57
// of 255.
TEST(Drum, AThickDarkRingIsNoPowder) {
  GrayImage photo = Draw({.depth = 0.5});
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double r = std::hypot(x + 0.5 - kCenterX, y + 0.5 - kCenterY);
      if (r < kRadius && r > 0.8 * kRadius) photo.at(x, y) = 5;
      if (r <= 0.8 * kRadius && photo.at(x, y) < 128) photo.at(x, y) = 70;
    }
  }
  const MeasuredDrum drum = MeasureDrum(
      {.photos = {Write("thick", photo)}, .diameter = 0.084, .circle_diameter = 0.084 / 0.8});
  const auto column = static_cast<int>(kCenterX);
  EXPECT_LE(drum.map.image.at(column, static_cast<int>(kCenterY + 0.7 * kRadius)), 5);
  EXPECT_GE(drum.map.image.at(column, static_cast<int>(kCenterY)), 250);
}

TEST(Drum, ADimPhotographIsRead) {
  GrayImage photo = Draw({.angle = 33 * kDegree});
  for (std::uint8_t& level : photo.pixels) {
    const double l = level;
    const double dim = 14 + (l < 170 ? (l - 15) * 54 / 155 : 54 + (l - 170) * 4 / 70);
    level = static_cast<std::uint8_t>(dim + 0.5);
  }
  const MeasuredDrum drum = MeasureDrum({.photos = {Write("dim", photo)}, .diameter = 0.084});
  EXPECT_NEAR(drum.map.circle.radius, kRadius, 0.7);
  EXPECT_NEAR(drum.angle.value / kDegree, 33, 0.2);
}

// 40 grey levels of light and 8 of powder were "no powder before a light background".
TEST(Drum, AVeryDimPhotographIsRead) {
  GrayImage photo = Draw({.angle = 33 * kDegree});
  for (std::uint8_t& level : photo.pixels) {
    level = static_cast<std::uint8_t>(8 + (level - 25) * 32.0 / 215 + 0.5);
  }
  const MeasuredDrum drum = MeasureDrum({.photos = {Write("very_dim", photo)}, .diameter = 0.084});
  EXPECT_NEAR(drum.angle.value / kDegree, 33, 0.3);
  EXPECT_NEAR(drum.surface.fill.value, Segment(0.2), 0.01);
}

// A ring of which 0.6 px are below the picture, which is allowed: the axis stays where it is.
TEST(Drum, OneThatIsCutALittleAtTheBottomKeepsItsAxis) {
  GrayImage photo = Draw({.angle = 33 * kDegree});
  photo.height = 287;
  photo.pixels.resize(static_cast<std::size_t>(kSide * photo.height));
  const MeasuredDrum drum = MeasureDrum({.photos = {Write("low", photo)}, .diameter = 0.084});
  const Frame frame = DrumProfile(drum).frame;
  EXPECT_NEAR(frame.baseline - frame.plate_diameter / (2 * frame.pixel_size),
              drum.map.circle.center_y, 1e-9);
  EXPECT_GT(frame.baseline, photo.height);
  base::Problems problems;
  frame.Validate(problems);
  EXPECT_TRUE(problems.empty());
  Frame heap = frame;
  heap.disc_diameter.reset();
  heap.Validate(problems);
  EXPECT_FALSE(problems.empty());
}

// The outermost edge is the outside of the ring, of 4 px in 140: taken for the inside it made the
// scale, and all that is measured, 3 % too small.
TEST(Drum, TheScaleIsThatOfTheRingsOutsideWhereItIsGiven) {
  DrumPhotos photos{.photos = {Write("ring", Draw({.angle = 33 * kDegree, .depth = 0.6}))},
                    .diameter = 0.136,
                    .circle_diameter = 0.140};
  const MeasuredDrum drum = MeasureDrum(photos);
  EXPECT_NEAR(drum.pixel_size, 0.5e-3, 0.005 * 0.5e-3);
  const Frame frame = DrumProfile(drum).frame;
  EXPECT_NEAR(frame.plate_diameter, 0.136, 1e-12);
  EXPECT_NEAR(frame.baseline, kCenterY + kRadius - 4, 1);
  EXPECT_LT(frame.disc_diameter.value(), 0.136);
  EXPECT_NEAR(drum.surface.fill.value, Segment(0.6 * kRadius / (kRadius - 4)), 0.005);
  photos.circle_diameter = 0.13;
  EXPECT_THAT(ErrorOf(photos), HasSubstr("circle_diameter: is 0.13, must be the drum's diameter"));
}

// A drum that turns the other way is the mirror image of one that turns as the rig does.
TEST(Drum, ProfileTurnsClockwise) {
  for (const double angle : {33 * kDegree, -33 * kDegree}) {
    const Profile profile = DrumProfile(Measure({.angle = angle}));
    const int x = static_cast<int>(profile.frame.center_x);
    const int y = static_cast<int>(profile.frame.baseline - kRadius);  // of the axis
    EXPECT_EQ(profile.image.at(x - 80, y), 0) << angle;  // 80 px left of it: 15 px below the plane
    EXPECT_EQ(profile.image.at(x + 80, y), 255) << angle;
    EXPECT_NEAR(profile.frame.pixel_size, 0.084 / (2 * kRadius), 0.005 * 0.084 / (2 * kRadius));
    // The ring of 4 px is left out, and a little more as the lens blurs it.
    EXPECT_LT(profile.frame.disc_diameter.value(), 0.084 * (kRadius - 4) / kRadius);
    EXPECT_GT(profile.frame.disc_diameter.value(), 0.084 * (kRadius - 8) / kRadius);
    base::Problems problems;
    profile.frame.Validate(problems);
    EXPECT_TRUE(problems.empty());
  }
}

TEST(Drum, WhatWasFoundIsDrawn) {
  const Drawn drawn{.angle = 33 * kDegree};
  const ColorImage picture = DrawDrum(Draw(drawn), Measure(drawn));
  for (const Color& color : {Color{230, 30, 30}, Color{40, 90, 240}, Color{0, 170, 60}}) {
    EXPECT_TRUE(std::ranges::find(picture.pixels, color) != picture.pixels.end());
  }
}

TEST(Drum, ErrorsSayWhatToDo) {
  const fs::path good = Write("good", Draw({.angle = 33 * kDegree}));
  EXPECT_THAT(ErrorOf({.photos = {good}, .diameter = 84}), HasSubstr("84 mm"));
  EXPECT_THAT(ErrorOf({.photos = {good}, .diameter = 0.084, .turning = Turning::kCounterClockwise}),
              HasSubstr("higher on the left"));
  const GrayImage blank{.width = 50, .height = 50, .pixels = std::vector<std::uint8_t>(2500, 99)};
  EXPECT_THAT(ErrorOf({.photos = {Write("blank", blank)}, .diameter = 0.084}),
              HasSubstr("no drum found"));
  const fs::path empty = Write("empty", Draw({.depth = 2}));
  EXPECT_THAT(ErrorOf({.photos = {empty}, .diameter = 0.084}), HasSubstr("shows no powder"));
  GrayImage moved = Draw({.angle = 33 * kDegree});
  std::rotate(moved.pixels.begin(), moved.pixels.begin() + 5, moved.pixels.end());
  EXPECT_THAT(ErrorOf({.photos = {good, Write("moved", moved)}, .diameter = 0.084}),
              HasSubstr("stands still"));
}

class DrumFills : public testing::TestWithParam<double> {};

// Both were measured without a word, an angle and a fill of what is no powder.
TEST_P(DrumFills, UpsideDownOrInverseIsRefusedAndUprightIsNot) {
  const GrayImage upright = Draw({.angle = 35 * kDegree, .depth = GetParam()});
  GrayImage upside_down = upright;
  std::ranges::reverse(upside_down.pixels);
  EXPECT_EQ(ErrorOf({.photos = {Write("upright", upright)}, .diameter = 0.084}), "");
  for (const GrayImage& wrong : {upside_down, Inverse(upright)}) {
    EXPECT_THAT(ErrorOf({.photos = {Write("wrong", wrong)}, .diameter = 0.084}),
                AllOf(HasSubstr("drum_wrong.png: the powder lies at the top"), HasSubstr("turn")));
  }
}
// Fills of 0.1, 0.26, 0.5, 0.74 and 0.9.
INSTANTIATE_TEST_SUITE_P(EmptyToFull, DrumFills, testing::Values(0.69, 0.38, 0.0, -0.38, -0.69));

// Powder all around, as in a drum that turns so fast that it centrifuges, and a little more of it
// at the top, where it is slower.
TEST(Drum, CentrifugingPowderIsNotTakenForUpsideDown) {
  GrayImage photo = Draw({.depth = 2});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double right = x + 0.5 - kCenterX, up = kCenterY - y - 0.5;
      const double r = std::hypot(right, up);
      if (r < kRadius && std::hypot(right, up + 5) > 105) photo.at(x, y) = 25;
    }
  }
  const fs::path file = Write("centrifuging", photo);
  const MeasuredDrum drum = MeasureDrum({.photos = {file}, .diameter = 0.084});
  EXPECT_FALSE(drum.surface.slope_angle.defined());
  EXPECT_FALSE(drum.surface.fill.defined());  // that of a flat surface was said
  EXPECT_FALSE(drum.turning);                 // nobody can see it
  EXPECT_EQ(
      MeasureDrum({.photos = {file}, .diameter = 0.084, .turning = Turning::kCounterClockwise})
          .turning,
      Turning::kCounterClockwise);
}

// Far thicker at the top, and still all around.
TEST(Drum, CentrifugingPowderThatIsThickerAtTheTopIsNotTakenForUpsideDown) {
  GrayImage photo = Draw({.depth = 2});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double right = x + 0.5 - kCenterX, up = kCenterY - y - 0.5;
      if (std::hypot(right, up) < kRadius && std::hypot(right, up + 15) > 0.7 * kRadius) {
        photo.at(x, y) = 25;
      }
    }
  }
  EXPECT_EQ(ErrorOf({.photos = {Write("thick_top", photo)}, .diameter = 0.084}), "");
}

// Its fill would be that of what is seen.
TEST(Drum, OneThatIsCutOffIsRefused) {
  const GrayImage whole = Draw({.angle = 0.5});
  for (const int left : {10, 30}) {  // columns; the ring begins at the 12th
    GrayImage cut{.width = kSide - left, .height = kSide, .pixels = {}};
    for (int y = 0; y < kSide; ++y) {
      for (int x = left; x < kSide; ++x) cut.pixels.push_back(whole.at(x, y));
    }
    const DrumPhotos photos{.photos = {Write("cut", cut)}, .diameter = 0.084};
    if (left == 10) {
      EXPECT_NO_THROW(MeasureDrum(photos));
      continue;
    }
    try {
      MeasureDrum(photos);
      FAIL() << "a drum that is cut off was measured";
    } catch (const base::ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("px out of the picture"));
    }
  }
}

// A drum far off was said not to stand in the picture's middle.
TEST(Drum, ASmallOneIsToBeCutOut) {
  const GrayImage large = Draw({.angle = 33 * kDegree});
  constexpr int kFar = 800;
  GrayImage small{.width = kFar, .height = kFar, .pixels = {}};
  small.pixels.assign(static_cast<std::size_t>(kFar) * kFar, 170);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      small.at(x + (kFar - kSide) / 2, y + (kFar - kSide) / 2) = large.at(x, y);
    }
  }
  EXPECT_THAT(ErrorOf({.photos = {Write("small", small)}, .diameter = 0.084}),
              HasSubstr("cut the picture down to the drum"));
}

// One level within its pixels' scatter was refused for the direction that was said, and of a series
// an angle against that direction was taken for one along it.
TEST(Drum, ALevelSurfaceTurnsTheWayThatIsSaid) {
  const fs::path file = Write("level", Draw({.angle = 1 * kDegree}));
  for (const std::vector<fs::path>& photos : {std::vector{file}, std::vector{file, file}}) {
    for (const Turning turning : {Turning::kClockwise, Turning::kCounterClockwise}) {
      const MeasuredDrum drum =
          MeasureDrum({.photos = photos, .diameter = 0.084, .turning = turning});
      EXPECT_EQ(drum.turning, turning);
      const double sign = turning == Turning::kClockwise ? 1 : -1;
      EXPECT_NEAR(drum.angle.value, sign * kDegree, 0.3 * kDegree);  // a pixel over the chord
      EXPECT_GT(drum.surface.slope_angle.value, 0);
    }
  }
}

}  // namespace drum_test
}  // namespace talus::imaging
