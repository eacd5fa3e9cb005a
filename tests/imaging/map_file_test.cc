#include "imaging/formats/images/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/photos/experiment.h"

namespace talus::imaging {
namespace map_file_test {

std::filesystem::path TempFile(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

// 120 × 80 px, base of 60 px from column 20 to 79 with its top at row 70, a grey layer above.
GrayImage DrawnMap() {
  GrayImage map{.width = 120, .height = 80, .pixels = std::vector<std::uint8_t>(120 * 80, 255)};
  for (int y = 50; y < 70; ++y) {
    for (int x = 20; x < 80; ++x) map.at(x, y) = 0;
  }
  for (int x = 30; x < 70; ++x) map.at(x, 49) = 128;
  map.at(19, 69) = 200;  // a grain over the rim in some views
  return map;
}

TEST(Map, BaseIsFoundInTheLowestRow) {
  WritePng(TempFile("map.png"), DrawnMap());
  const Profile profile = ReadMap(TempFile("map.png"), 0.012, {});
  // The grain that is there in a fifth of the views moves that end by a fifth of a pixel.
  EXPECT_NEAR(profile.frame.plate_diameter / profile.frame.pixel_size, 60, 0.25);
  EXPECT_NEAR(profile.frame.center_x, 50, 0.15);
  EXPECT_DOUBLE_EQ(profile.frame.baseline, 70);
  EXPECT_EQ(profile.image, DrawnMap());
}

// The lowest row's centre is half a pixel above the base, where the slopes have narrowed the heap:
// a map that was read back had its pixels 0.3 to 1.4 % too large.
TEST(Map, TheBaseIsAsWideAsTheHeapIsThere) {
  for (const double degrees : {20.0, 28.0, 45.0, 80.0}) {
    constexpr double kBase = 100;  // [px]
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    GrayImage map{.width = 160, .height = 320, .pixels = std::vector<std::uint8_t>(160 * 320, 255)};
    for (int y = 0; y < 300; ++y) {
      const double half = kBase / 2 - (300 - y - 0.5) / slope;  // at the row's centre
      for (int x = 0; x < 160; ++x) {
        const double covered = std::clamp(half - std::abs(x + 0.5 - 80.3) + 0.5, 0.0, 1.0);
        map.at(x, y) = static_cast<std::uint8_t>(255 * (1 - covered) + 0.5);
      }
    }
    WritePng(TempFile("slopes.png"), map);
    const Frame frame = ReadMap(TempFile("slopes.png"), 0.01, {}).frame;
    EXPECT_NEAR(frame.plate_diameter / frame.pixel_size, kBase, 0.002 * kBase) << degrees;
    EXPECT_NEAR(frame.center_x, 80.3, 0.15) << degrees;  // between pixel centres
  }
}

// A heap of 70 px on a layer of one row over a plate of 100: drawn on, the plate was 118 px wide.
TEST(Map, ALayerUnderTheHeapIsNoSlope) {
  GrayImage map{.width = 160, .height = 120, .pixels = std::vector<std::uint8_t>(160 * 120, 255)};
  for (int y = 70; y < 100; ++y) {
    const int half = y == 99 ? 50 : 35 - (99 - y);
    for (int x = 80 - half; x < 80 + half; ++x) map.at(x, y) = 0;
  }
  WritePng(TempFile("layer.png"), map);
  const Frame frame = ReadMap(TempFile("layer.png"), 0.01, {}).frame;
  EXPECT_DOUBLE_EQ(frame.plate_diameter / frame.pixel_size, 100);
}

// The plate, drawn black below the heap, is not powder when the frame says where it begins.
TEST(Map, FrameBlanksWhatIsBelowTheBaseline) {
  GrayImage map = DrawnMap();
  for (int x = 0; x < 120; ++x) map.at(x, 75) = 0;
  WritePng(TempFile("plate.png"), map);
  const Frame frame{.width = 120,
                    .height = 80,
                    .pixel_size = 2e-4,
                    .center_x = 50,
                    .baseline = 70,
                    .plate_diameter = 0.012};
  EXPECT_EQ(ReadMap(TempFile("plate.png"), 0.012, frame).image, DrawnMap());
  EXPECT_THROW(ReadMap(TempFile("plate.png"), 0.012, {}), base::ConfigError);
}

// A simulated picture shows the disc alone; the map was compared with its ring and all beside it.
TEST(Map, OfADrumOnlyTheDiscCounts) {
  WritePng(TempFile("disc.png"),
           {.width = 60, .height = 60, .pixels = std::vector<std::uint8_t>(60 * 60, 0)});
  const Frame frame{.width = 60,
                    .height = 60,
                    .pixel_size = 1e-3,
                    .center_x = 30,
                    .baseline = 60,
                    .plate_diameter = 0.06,
                    .disc_diameter = 0.05};
  const Profile profile = ReadMap(TempFile("disc.png"), 0.06, frame);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      EXPECT_EQ(profile.image.at(x, y), frame.Knows(x, y) ? 0 : 255) << x << ' ' << y;
    }
  }
}

TEST(Map, WhiteAndBlackMapsAreErrorsThatNameTheFile) {
  for (const std::uint8_t level : {0, 255}) {
    WritePng(TempFile("plain.png"),
             {.width = 50, .height = 40, .pixels = std::vector<std::uint8_t>(50 * 40, level)});
    try {
      ReadMap(TempFile("plain.png"), 0.01, {});
      FAIL() << "no error at " << int(level);
    } catch (const base::ConfigError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("plain.png"));
    }
  }
}

// Each was read and had no effect.
TEST(Map, KeysOfPhotographsAreRefusedAndRunsHaveNames) {
  const auto error_of = [](const ExperimentOptions& options) {
    base::Problems problems;
    options.Validate(problems);
    try {
      problems.ThrowIfAny();
    } catch (const base::ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  ExperimentOptions map;
  map.map = "map.png";
  map.plate_diameter = 0.01;
  EXPECT_EQ(error_of(map), "");
  map.pattern = "{run}.png";
  map.powder = PowderLook::kDark;
  map.allow_missing_views = true;
  for (const char* key : {"pattern: is of the photographs", "powder: is of photographs",
                          "allow_missing_views: is of photographs"}) {
    EXPECT_THAT(error_of(map), testing::HasSubstr(key));
  }
  ExperimentOptions runs;
  runs.plate_diameter = 0.01;
  runs.runs = {{.name = "1", .photos = {"a.png"}}, {.name = "1", .photos = {"b.png"}}};
  EXPECT_THAT(error_of(runs), testing::HasSubstr("run \"1\" stands there twice"));
}

// A published measurement that is not part of the project: TALUS_REAL_DATA names its folder. Its
// base is 85 px wide, and the wet sand overhangs, so that it has no angle of repose.
TEST(Map, WetSand) {
  const char* const folder = std::getenv("TALUS_REAL_DATA");
  if (folder == nullptr) GTEST_SKIP() << "TALUS_REAL_DATA is not set";
  ExperimentOptions options;
  options.map = std::filesystem::path(folder) / "granuheap_wet_sand_map.png";
  options.plate_diameter = 0.01;
  const Experiment experiment = MeasureExperiment(options);
  const Frame& frame = experiment.aehp.frame;
  EXPECT_NEAR(frame.plate_diameter / frame.pixel_size, 85, 0.5);
  EXPECT_EQ(frame.baseline, 540);
  EXPECT_NEAR(Nebp(experiment.aehp.image), 4211.7, 0.1);  // Σ(255 − I)/255 of the file
  const Measured& angle = FindMetric(experiment.metrics, "repose_angle_2_mean_deg").value;
  EXPECT_THAT(angle.not_defined, testing::HasSubstr("overhangs"));
}

}  // namespace map_file_test
}  // namespace talus::imaging
