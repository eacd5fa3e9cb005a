// The photographs that come with the project: what a user's first measurement gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "imaging/photos/experiment.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace powder_a_test {

const Experiment& PowderA() {
  static const Experiment experiment = [] {
    ExperimentOptions options;
    options.photos = TALUS_SOURCE_DIR "/examples/photos/powder_a";
    options.plate_diameter = 0.01;
    return MeasureExperiment(options);
  }();
  return experiment;
}

// Half a pixel is 0.15 % of the scale; 0.1° moves the plate's ends by 0.3 px. The camera stands
// still during a run, so its views must agree on the tilt.
TEST(PowderA, PlateIsFoundInEveryPhotograph) {
  ASSERT_EQ(PowderA().runs.size(), 5u);
  for (const MeasuredRun& run : PowderA().runs) {
    ASSERT_EQ(run.views.size(), 16u);
    for (const MeasuredView& view : run.views) {
      EXPECT_NEAR(view.plate.width, 338, 0.5) << view.photo;
      EXPECT_NEAR(view.plate.tilt, run.views[0].plate.tilt, 0.1 * std::numbers::pi / 180);
      EXPECT_NEAR(view.plate.baseline, run.views[0].plate.baseline, 0.1) << view.photo;
      EXPECT_NEAR(view.plate.center_x, run.views[0].plate.center_x, 0.1) << view.photo;
    }
  }
  EXPECT_TRUE(PowderA().warnings.empty());
}

GrayImage MeanOfRuns(const std::vector<std::size_t>& runs) {
  std::vector<GrayImage> images;
  for (const std::size_t run : runs) images.push_back(PowderA().runs[run].profile.image);
  return MeanImage(images);
}

// Where runs scatter with standard deviation s, leaving one out differs by s √(1 + 1/4), halves
// of two and three runs by s √(1/2 + 1/3), 0.82 of it: each split must stay below the floor times
// the scatter that five runs leave in it (their leave-one-out values reach 1.4 × the mean).
TEST(PowderA, HalvesOfTheRunsDifferByNoMoreThanTheNoiseFloor) {
  const NoiseFloor& floor = *PowderA().noise_floor;
  double mean = 0;
  int splits = 0;
  for (std::size_t a = 0; a < 5; ++a) {
    for (std::size_t b = a + 1; b < 5; ++b) {
      std::vector<std::size_t> others;
      for (std::size_t run = 0; run < 5; ++run) {
        if (run != a && run != b) others.push_back(run);
      }
      const double sad = Sad(MeanOfRuns({a, b}), MeanOfRuns(others));
      EXPECT_LT(sad, 1.4 * floor.mean_sad_px);
      mean += sad;
      ++splits;
    }
  }
  EXPECT_NEAR(mean / splits / floor.mean_sad_px, 0.82, 0.12);
}

}  // namespace powder_a_test
}  // namespace talus::imaging
