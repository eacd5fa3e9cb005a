// A heap on a table, without a plate: its scale is a known length in the photograph.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "imaging/formats/images/image_file.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace table_test {

using testing::HasSubstr;

// A table is a plate that ends nowhere.
Scene TableScene() {
  Scene scene = SmallScene();
  scene.plate_width = 5000;
  scene.plate_depth = 500;
  scene.tilt = 1.2 * std::numbers::pi / 180;
  scene.uneven = true;
  return scene;
}

// A triangle of 150 px height over 240 px, 15 mm by 24 mm at 0.1 mm a pixel, and at the left a
// ruler of 20 px by 60 px that stands on the table, too.
GrayImage HeapOnTable(const Scene& scene) {
  const auto dark = [](double x, double up) {
    const bool heap = up > 0 && up < 150 * (1 - std::abs(x - 10) / 120);
    return heap || (up > 0 && up < 60 && std::abs(x + 170) < 10);
  };
  return Expose(scene, Cover(scene, dark));
}

// The outline's corners are the blur's; the angle is of straight slopes. The centre of a triangle's
// area stands over the middle of its base.
TEST(TableTest, AHeapOnATableIsMeasuredByARuler) {
  const fs::path folder = EmptyFolder("table");
  for (int view = 0; view < 2; ++view) {
    Scene scene = TableScene();
    scene.center_x += 5.3 * view;
    scene.baseline -= 1.7 * view;
    scene.tilt *= 1 - 2 * view;
    WritePng(folder / Name(1, view), HeapOnTable(scene));
  }
  ExperimentOptions options;
  options.photos = folder;
  options.scale = "30,200 - 30,100 = 10 mm";
  const Experiment experiment = MeasureExperiment(options);
  EXPECT_TRUE(experiment.warnings.empty());
  const Frame& frame = experiment.aehp.frame;
  EXPECT_DOUBLE_EQ(frame.pixel_size, 1e-4);
  EXPECT_NEAR(frame.plate_diameter, 0.027, 1e-9);  // 1.1 × 24 mm, to the next millimetre
  EXPECT_NEAR(Nebp(experiment.aehp.image) * 0.01, 0.5 * 24 * 15, 0.01 * 180);  // [mm²]
  for (std::size_t view = 0; view < 2; ++view) {
    const MeasuredView& measured = experiment.runs[0].views[view];
    const double sign = 1 - 2 * static_cast<double>(view);
    EXPECT_NEAR(measured.plate.tilt, sign * 1.2 * std::numbers::pi / 180, 1e-3);
    EXPECT_NEAR(measured.plate.center_x, 210 + 5.3 * static_cast<double>(view) + 10, 0.7);
    const double angle = std::atan2(150, 120);  // [rad]
    EXPECT_NEAR(measured.angles[1].left.value, angle, 0.01);
    EXPECT_NEAR(measured.angles[1].right.value, angle, 0.01);
  }
}

// Light pixels in the picture's lowest row, under the heap, made centre and baseline no numbers,
// and with them the frame of all photographs; under a deep table one was refused as no table.
TEST(TableTest, HotPixelsInTheLowestRowChangeNothing) {
  ExperimentOptions options;
  options.photos = EmptyFolder("hot_pixel");
  options.scale = "30,200 - 30,100 = 10 mm";
  for (const auto& [depth, num_hot] : {std::pair{40, 1}, std::pair{3, 1}, std::pair{3, 5}}) {
    Scene scene = TableScene();
    scene.tilt = 0;
    scene.height = static_cast<int>(scene.baseline) + depth;
    GrayImage photo = HeapOnTable(scene);
    WritePng(options.photos / Name(1, 0), photo);
    const Experiment usual = MeasureExperiment(options);
    for (int x = 200; x < 200 + num_hot; ++x) photo.at(x, photo.height - 1) = 255;
    WritePng(options.photos / Name(1, 0), photo);
    const Experiment hot = MeasureExperiment(options);
    const PlatePose& place = hot.runs[0].views[0].plate;
    EXPECT_NEAR(place.center_x, usual.runs[0].views[0].plate.center_x, 2) << depth;
    EXPECT_NEAR(place.baseline, usual.runs[0].views[0].plate.baseline, 0.2) << depth;
    EXPECT_NEAR(Nebp(hot.aehp.image), Nebp(usual.aehp.image), 0.01 * Nebp(usual.aehp.image));
  }
}

ExperimentOptions OnTable(const fs::path& folder) {
  ExperimentOptions options;
  options.photos = folder;
  options.scale = "30,200 - 30,100 = 10 mm";
  return options;
}

// It was counted as powder, with 1200 px of 18 000, as soon as the part that counts reached it.
TEST(TableTest, WhatStandsApartFromTheHeapIsLeftOutHoweverMuchOfTheTableCounts) {
  const fs::path folder = EmptyFolder("wide_table");
  WritePng(folder / Name(1, 0), HeapOnTable(TableScene()));
  ExperimentOptions options = OnTable(folder);
  const Experiment narrow = MeasureExperiment(options);
  options.plate_diameter = 0.038;  // half of it, 190 px, reaches beyond the ruler's 180 + 10
  const Experiment wide = MeasureExperiment(options);
  EXPECT_EQ(wide.aehp.frame.plate_diameter, 0.038);
  EXPECT_EQ(wide.aehp.image, narrow.aehp.image);
  EXPECT_TRUE(wide.warnings.empty());
}

// It was of a triangle as wide as the part that counts, which is nobody's measure: 47.9 and 29.9
// degrees in place of 51.3. The blur of the feet widens the base by up to 1 %.
TEST(TableTest, TheTriangleStandsOnTheHeapsOwnBase) {
  const fs::path folder = EmptyFolder("triangle_on_table");
  WritePng(folder / Name(1, 0), HeapOnTable(TableScene()));
  ExperimentOptions options = OnTable(folder);
  for (const double part : {0.025, 0.037}) {
    options.plate_diameter = part;
    const Experiment experiment = MeasureExperiment(options);
    const auto value = [&](const char* name) {
      return FindMetric(experiment.metrics, name).value.value;
    };
    const double angle = std::atan2(150, 120) * 180 / std::numbers::pi;
    EXPECT_NEAR(value("triangle_angle_deg"), angle, 0.7);
    EXPECT_LT(value("static_cohesive_index"), 0.03);
  }
}

// A grain of 8 px beside the heap of 150 px is powder, as one on a plate is.
TEST(TableTest, AGrainBesideTheHeapIsKept) {
  const fs::path folder = EmptyFolder("grain_on_table");
  const auto dark = [](double x, double up) {
    const bool heap = up > 0 && up < 150 * (1 - std::abs(x - 10) / 120);
    return heap || std::hypot(x - 140, up - 8) < 8;
  };
  const Scene scene = TableScene();
  WritePng(folder / Name(1, 0), Expose(scene, Cover(scene, dark)));
  ExperimentOptions options = OnTable(folder);
  options.plate_diameter = 0.03;
  const Experiment experiment = MeasureExperiment(options);
  const Frame& frame = experiment.aehp.frame;
  EXPECT_EQ(experiment.aehp.image.at(static_cast<int>(frame.center_x + 130),
                                     static_cast<int>(frame.baseline - 8)),
            0);
  // The triangle stands on the heap alone.
  const double angle = std::atan2(150, 120) * 180 / std::numbers::pi;
  EXPECT_NEAR(FindMetric(experiment.metrics, "triangle_angle_deg").value.value, angle, 0.7);
}

// The picture shows 220 of 250 px left of the heap and 200 right of it: 80 of 500 are not seen.
// A funnel on a stand has more area than the heap that it has poured.
TEST(TableTest, AThingLargerThanTheHeapIsNotTakenForIt) {
  const fs::path folder = EmptyFolder("stand_on_table");
  const auto dark = [](double x, double up) {
    const bool heap = up > 0 && up < 60 * (1 - std::abs(x - 10) / 100);
    const bool stand = up > 0 && std::abs(x - 150) < 6;
    return heap || stand || (up > 120 && std::abs(x - 60) < 120);
  };
  const Scene scene = TableScene();
  WritePng(folder / Name(1, 0), Expose(scene, Cover(scene, dark)));
  ExperimentOptions options = OnTable(folder);
  options.plate_diameter = 0.03;
  const Experiment experiment = MeasureExperiment(options);
  EXPECT_NEAR(Nebp(experiment.aehp.image), 60 * 100, 150);  // within a pixel along its sides
}

TEST(TableTest, APartThatReachesBeyondThePictureIsWarnedOf) {
  const fs::path folder = EmptyFolder("beyond");
  WritePng(folder / Name(1, 0), HeapOnTable(TableScene()));
  ExperimentOptions options = OnTable(folder);
  options.plate_diameter = 0.05;
  const std::vector<PhotoWarning> warnings = MeasureExperiment(options).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kBeyondPicture);
  EXPECT_NEAR(warnings[0].value, 0.16, 0.005);
  EXPECT_THAT(WarningText(warnings[0]), HasSubstr("16 % of the part of the table that counts"));
}

TEST(TableTest, AMarkLongerThanThePictureIsRefused) {
  const fs::path folder = EmptyFolder("far_mark");
  WritePng(folder / Name(1, 0), HeapOnTable(TableScene()));
  ExperimentOptions options = OnTable(folder);
  options.scale = "30,200 - 4000,200 = 10 mm";
  EXPECT_THAT(ErrorOf(options),
              HasSubstr("scale: is longer than the photographs, which are 420 x 220 px"));
  options.scale = "30,400 - 30,300 = 10 mm";  // read off before the picture was cropped
  EXPECT_EQ(ErrorOf(options), "");
}

TEST(TableTest, WithoutPlateTheErrorSaysHowToScale) {
  const fs::path folder = EmptyFolder("no_scale");
  WritePng(folder / Name(1, 0), HeapOnTable(TableScene()));
  EXPECT_THAT(ErrorOf(Options(folder)), HasSubstr("--scale \"104,310-884,312=30 mm\""));
  ExperimentOptions options;
  options.photos = folder;
  for (const auto& [scale, why] :
       {std::pair{"30,200-30", "no \",\" where"}, std::pair{"30,200-x,9=1 mm", "no number"},
        std::pair{"30,200-30,100=10 s", "ends in no length"},
        std::pair{"30,200-31,201=10 mm", "less than 10 px"}}) {
    options.scale = scale;
    EXPECT_THAT(ErrorOf(options), HasSubstr(why)) << scale;
    EXPECT_THAT(ErrorOf(options), HasSubstr("write two points")) << scale;
  }
  options.scale = "30,200-30,100=10 mm";
  options.frame = Frame{};
  EXPECT_THAT(ErrorOf(options), HasSubstr("leave it out with a map or a frame"));
}

TEST(TableTest, ATableThatIsNoneIsNamed) {
  const auto error_of = [](const GrayImage& photo) {
    const fs::path folder = EmptyFolder("no_table");
    WritePng(folder / Name(1, 0), photo);
    ExperimentOptions options;
    options.photos = folder;
    options.scale = "30,200-30,100=10 mm";
    return ErrorOf(options);
  };
  EXPECT_THAT(error_of(Triangle(SmallScene())), HasSubstr("lower border is not dark"));
  EXPECT_THAT(error_of(PhotographOf(TableScene(), [](double) { return 0.0; })),
              HasSubstr("nothing stands on the table"));
  const auto saw = [](double x) { return 20 + 1.7 * std::abs(std::fmod(x + 600, 60) - 30); };
  EXPECT_THAT(error_of(PhotographOf(TableScene(), saw)), HasSubstr("no straight, level top"));
}

}  // namespace table_test
}  // namespace talus::imaging
