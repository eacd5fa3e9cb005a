// Which dark areas of a photograph are powder of the test.
#include "imaging/photos/silhouette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "imaging/photos/experiment.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace silhouette_test {

// A speck that floats and one beside the plate go, a hole fills, a grain on the plate stays.
TEST(Silhouette, KeepsWhatStandsOnThePlateAndFillsHoles) {
  const Scene scene = SmallScene();
  const auto in_disc = [](double x, double y, double cx, double cy, double r) {
    return std::hypot(x - cx, y - cy) < r;
  };
  const GrayImage photo = Expose(scene, Cover(scene, [&](double x, double up) {
                                   const bool heap = up > 0 && up < 0.6 * (90 - std::abs(x)) &&
                                                     !in_disc(x, up, 0, 20, 6);
                                   return heap || in_disc(x, up, -100, 60, 4) ||
                                          in_disc(x, up, 120, 6, 6) || in_disc(x, up, 180, 10, 5);
                                 }));
  const fs::path folder = EmptyFolder("specks");
  WritePng(folder / Name(1, 0), photo);
  const Experiment experiment = MeasureExperiment(Options(folder));
  const auto dark = [&](double along, double up) {
    const Frame& frame = experiment.aehp.frame;
    return experiment.aehp.image.at(static_cast<int>(frame.center_x + along),
                                    static_cast<int>(frame.baseline - up)) == 0;
  };
  EXPECT_TRUE(dark(0, 20));   // the hole
  EXPECT_TRUE(dark(120, 6));  // the grain on the plate
  EXPECT_FALSE(dark(-100, 60));
  EXPECT_FALSE(dark(180, 10));
}

// Grains beyond the own length of a column that has collapsed count, and are no other thing.
TEST(Silhouette, PowderMayLieAnywhereOnAFloor) {
  const Scene scene = SmallScene();
  const fs::path folder = EmptyFolder("collapsed");
  WritePng(folder / Name(1, 0), Expose(scene, Cover(scene, [&](double x, double up) {
                                         return (up > 0 && up < 0.6 * (90 - std::abs(x))) ||
                                                std::hypot(x - 180, up - 4) < 5;
                                       })));
  ExperimentOptions options = Options(folder);
  const auto is_there = [](const Experiment& experiment) {
    const Frame& frame = experiment.aehp.frame;
    return experiment.aehp.image.at(static_cast<int>(frame.center_x + 180),
                                    static_cast<int>(frame.baseline - 4)) == 0;
  };
  EXPECT_FALSE(is_there(MeasureExperiment(options)));
  options.ground = Ground::kFloor;
  const Experiment experiment = MeasureExperiment(options);
  EXPECT_TRUE(is_there(experiment));
  EXPECT_THAT(experiment.warnings, testing::IsEmpty());
}

}  // namespace silhouette_test
}  // namespace talus::imaging
