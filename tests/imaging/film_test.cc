// Films: the pictures of one run at several times, side by side.
#include "imaging/photos/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/difference_map.h"
#include "imaging/heap/film_strip.h"
#include "imaging/heap/metrics.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace film_test {

using ::testing::HasSubstr;

constexpr int kWidth = 100;
constexpr int kHeight = 60;

Frame FrameOfMaps() {
  return {.width = kWidth,
          .height = kHeight,
          .pixel_size = 2e-4,
          .center_x = 50,
          .baseline = 50,
          .plate_diameter = 0.012};
}

// A block so high, and `half` pixels wide on either side of the centre.
GrayImage Block(int half, int height) {
  GrayImage image{.width = kWidth,
                  .height = kHeight,
                  .pixels = std::vector<std::uint8_t>(kWidth * kHeight, 255)};
  for (int y = 50 - height; y < 50; ++y) {
    for (int x = 50 - half; x < 50 + half; ++x) image.at(x, y) = 0;
  }
  return image;
}

std::filesystem::path Written(const std::string& name, const GrayImage& image) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("film_" + name + ".png");
  WritePng(path, image);
  return path;
}

ExperimentOptions FilmOf(std::vector<std::filesystem::path> maps) {
  ExperimentOptions options;
  options.plate_diameter = 0.012;
  options.frame = FrameOfMaps();
  options.film.emplace();
  for (std::filesystem::path& map : maps) {
    options.film->emplace_back();
    options.film->back().map = std::move(map);
  }
  return options;
}

TEST(Film, AStripHoldsItsPicturesAndOnePictureIsNoStrip) {
  const GrayImage pictures[] = {Block(10, 30), Block(20, 15), Block(30, 10)};
  const Profile strip{.image = SideBySide(pictures), .frame = StripOf(FrameOfMaps(), 3)};
  EXPECT_EQ(strip.frame.width, 3 * kWidth);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(PictureOf(strip, i).image, pictures[i]);
    EXPECT_EQ(PictureOf(strip, i).frame, FrameOfMaps());
  }
  EXPECT_EQ(StripOf(FrameOfMaps(), 1), FrameOfMaps());
  EXPECT_EQ(OnePicture(FrameOfMaps()), FrameOfMaps());
}

// A drum's picture counts within its disc, in each picture of a film.
TEST(Film, WhatIsKnownIsKnownInEachPicture) {
  Frame frame = FrameOfMaps();
  frame.disc_diameter = 0.01;
  const Frame strip = StripOf(frame, 2);
  int known = 0;
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_EQ(strip.Knows(x, 30), frame.Knows(x, 30));
    EXPECT_EQ(strip.Knows(x + kWidth, 30), frame.Knows(x, 30));
    known += frame.Knows(x, 30);
  }
  EXPECT_GT(known, 0);
  EXPECT_LT(known, kWidth);
}

TEST(Film, AreasAreSummedOverThePicturesAndShapesAreNotDefined) {
  const auto first = Written("first", Block(10, 30));
  const auto second = Written("second", Block(20, 15));
  const Experiment film = MeasureExperiment(FilmOf({first, second}));
  const Experiment still = MeasureExperiment(FilmOf({first, first}));
  EXPECT_EQ(film.aehp.frame.num_pictures(), 2);
  EXPECT_EQ(FindMetric(film.metrics, "nebp_px").value.value, 600 + 600);
  EXPECT_THAT(FindMetric(film.metrics, "repose_angle_1_mean_deg").value.not_defined,
              HasSubstr("another heap in each picture"));
  EXPECT_FALSE(FindMetric(film.metrics, "triangle_angle_deg").value.defined());
  const auto compared = CompareProfiles(still.Images(), film.Images());
  // The second pictures share 20 columns 15 px high: 300 px more in each.
  EXPECT_EQ(FindMetric(compared, "sad_px").value.value, 300 + 300);
  const ColorImage maps = DrawDifferenceMap(still.aehp, film.aehp);
  EXPECT_GT(maps.height,
            DrawDifferenceMap(PictureOf(still.aehp, 1), PictureOf(film.aehp, 1)).height);
}

// The runs of each time belong together by their order.
TEST(Film, ARunIsTheStripOfItsPictures) {
  Experiment at;  // a time that two runs were photographed at
  at.aehp = {.image = Block(20, 15), .frame = FrameOfMaps()};
  at.runs = {{.name = "a", .profile = {Block(20, 15), FrameOfMaps()}, .views = {}},
             {.name = "b", .profile = {Block(20, 16), FrameOfMaps()}, .views = {}}};
  const Experiment twice[] = {at, at};
  const Experiment film = JoinedFilm(twice);
  ASSERT_EQ(film.runs.size(), 2U);
  EXPECT_EQ(Sad(film.runs[0].profile.image, film.runs[1].profile.image), 40 + 40);
  EXPECT_EQ(film.runs[1].profile.frame.num_pictures(), 2);
}

TEST(Film, TimesThatDoNotGoTogetherAreRefused) {
  const auto whole = Written("whole", Block(10, 30));
  Experiment one, other;
  one.aehp = other.aehp = {.image = Block(10, 30), .frame = FrameOfMaps()};
  other.aehp.frame.baseline = 51;
  const Experiment moved[] = {one, other};
  EXPECT_THROW(JoinedFilm(moved), base::ConfigError);
  other = one;
  other.runs = {{.name = "a", .profile = one.aehp, .views = {}}};
  const Experiment uneven[] = {one, other};
  EXPECT_THROW(JoinedFilm(uneven), base::ConfigError);
  // As many, of which another had a photograph that could not be used: different heaps were joined.
  one.runs = {{.name = "b", .profile = one.aehp, .views = {}}};
  const Experiment others[] = {one, other};
  EXPECT_THAT([&] { JoinedFilm(others); },
              testing::ThrowsMessage<base::ConfigError>(
                  HasSubstr("film[1]: is of 1 run (a), the first picture of 1 run (b)")));
  EXPECT_THAT(ErrorOf(FilmOf({})), HasSubstr("film: is empty"));
  ExperimentOptions both = FilmOf({whole});
  both.map = whole;
  EXPECT_THAT(ErrorOf(both), HasSubstr("needs exactly one of"));
}

}  // namespace film_test
}  // namespace talus::imaging
