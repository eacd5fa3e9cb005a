// A series of photographs of a turning drum.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "imaging/drums/drum.h"
#include "tests/imaging/drum_photograph.h"

namespace talus::imaging {
namespace drum_test {

using testing::AllOf;
using testing::HasSubstr;

// Angles of 32, 33 and 34 degrees: their mean, a standard error of 1/√3, and a surface that moves.
TEST(DrumSeries, SeriesHasErrors) {
  std::vector<fs::path> photos;
  for (const double angle : {32.0, 33.0, 34.0}) {
    photos.push_back(Write(std::to_string(angle), Draw({.angle = angle * kDegree})));
  }
  const MeasuredDrum drum = MeasureDrum({.photos = photos, .diameter = 0.084});
  EXPECT_NEAR(drum.angle.value / kDegree, 33, 0.2);
  EXPECT_NEAR(drum.angle.standard_error / kDegree, 1 / std::sqrt(3.0), 0.05);
  // A plane 0.2 radii below the axis that turns by 1° about it: 1.36 px of 0.3 mm at the mean.
  EXPECT_NEAR(drum.surface_sd, 4.1e-4, 0.4e-4);
}

// The mean picture of 30, 30, 30 and 42 degrees has a surface of 30.3, and the rig the mean of 33.
TEST(DrumSeries, ASkewedSeriesHasTheMeanOfItsAngles) {
  std::vector<fs::path> photos;
  for (const double angle : {30.0, 30.0, 30.0, 42.0}) {
    photos.push_back(
        Write("skewed" + std::to_string(photos.size()), Draw({.angle = angle * kDegree})));
  }
  const MeasuredDrum drum = MeasureDrum({.photos = photos, .diameter = 0.084});
  EXPECT_NEAR(drum.angle.value / kDegree, 33, 0.1);
  EXPECT_NEAR(drum.angle.standard_error / kDegree, 3, 0.1);  // 6/√4
  const MeasuredDrum two = MeasureDrum({.photos = {photos[0], photos[3]}, .diameter = 0.084});
  EXPECT_NEAR(two.surface.fill.value, Measure({.angle = 36 * kDegree}).surface.fill.value, 0.003);
}

// Their average is no powder's: a fill of a half and a slope of nothing.
TEST(DrumSeries, ASeriesWithAMirroredPictureIsRefused) {
  const fs::path right = Write("right", Draw({.angle = 35 * kDegree}));
  const fs::path mirrored = Write("mirrored", Draw({.angle = -35 * kDegree}));
  for (const std::vector<fs::path>& photos :
       {std::vector{right, mirrored}, std::vector{right, right, mirrored}}) {
    EXPECT_THAT(ErrorOf({.photos = photos, .diameter = 0.084}),
                HasSubstr(mirrored.string() + ": the powder is higher on the right, in " +
                          right.string() + " on the left"));
  }
  EXPECT_EQ(ErrorOf({.photos = {mirrored, mirrored}, .diameter = 0.084}), "");
}

// Their average would be of neither light, and it was taken.
TEST(DrumSeries, APhotographLitOtherwiseThanItsSeriesIsNamed) {
  const GrayImage photo = Draw({.angle = 33 * kDegree});
  const GrayImage inverse = Inverse(photo);
  GrayImage darker = photo;
  for (std::uint8_t& level : darker.pixels) level = static_cast<std::uint8_t>(level / 2);
  const fs::path good = Write("usual", photo);
  EXPECT_THAT(ErrorOf({.photos = {good, Write("inverse", inverse)}, .diameter = 0.084}),
              AllOf(HasSubstr("drum_inverse.png"), HasSubstr("lit otherwise than its series")));
  EXPECT_THAT(ErrorOf({.photos = {good, good, Write("darker", darker)}, .diameter = 0.084}),
              AllOf(HasSubstr("drum_darker.png"), HasSubstr("0.5 times as bright")));
}

// Nobody said how it turns: the mean picture of -1, -1, -1 and 4.5 degrees leans to the right, the
// mean angle to the left, which has to be that of the turning.
TEST(DrumSeries, ASeriesTurnsAsItsMeanAngleLeans) {
  std::vector<fs::path> photos;
  for (const double angle : {-1.0, -1.0, -1.0, 4.5}) {
    photos.push_back(
        Write("leaning" + std::to_string(photos.size()), Draw({.angle = angle * kDegree})));
  }
  const MeasuredDrum drum = MeasureDrum({.photos = photos, .diameter = 0.084});
  EXPECT_EQ(drum.turning, Turning::kClockwise);
  EXPECT_NEAR(drum.angle.value / kDegree, 0.375, 0.2);
}

}  // namespace drum_test
}  // namespace talus::imaging
