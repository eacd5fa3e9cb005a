#include "imaging/photos/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "imaging/formats/images/photograph_file.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace overlay_test {

// Two runs of a triangle of 300 × 75 px, photographed by a camera that leans by 2°.
Scene Leaning() {
  Scene scene = SmallScene();
  scene.tilt = 2 * std::numbers::pi / 180;
  return scene;
}

Experiment MeasureLeaning(const fs::path& folder) {
  for (int run = 1; run <= 2; ++run) {
    Scene scene = Leaning();
    scene.seed = static_cast<std::uint64_t>(run);
    WritePng(folder / Name(run, 0), Triangle(scene));
  }
  return MeasureExperiment(Options(folder));
}

// In the plate's coordinates, from the middle of its top [px].
struct OnPlate {
  double along = 0;
  double up = 0;
};

OnPlate PlateCoordinates(const ColorImage& overlay, std::size_t pixel) {
  const Scene scene = Leaning();
  const auto width = static_cast<std::size_t>(overlay.width);
  const double zoom = overlay.width / static_cast<double>(scene.width);
  const double dx = (static_cast<double>(pixel % width) + 0.5) / zoom - scene.center_x;
  const double dy = (static_cast<double>(pixel / width) + 0.5) / zoom - scene.baseline;
  const double c = std::cos(scene.tilt), s = std::sin(scene.tilt);
  return {.along = dx * c + dy * s, .up = dx * s - dy * c};
}

// A tilt taken the other way round would put its ends 10 px off.
TEST(Overlay, LiesOnWhatThePhotographShows) {
  const fs::path folder = EmptyFolder("overlay");
  const Experiment experiment = MeasureLeaning(folder);
  const ColorImage overlay = OverlayOf(experiment.runs[0].views[0], experiment.aehp.frame,
                                       Options(folder), experiment.photo_pixel);
  int red = 0, blue = 0;  // lines are drawn smoothly: what is nearly of their colour
  for (std::size_t i = 0; i < overlay.pixels.size(); ++i) {
    const auto [along, up] = PlateCoordinates(overlay, i);
    const auto& [r, g, b] = overlay.pixels[i];
    if (r - std::max(g, b) > 80) {
      const double from_side = (up - 0.5 * (150 - std::abs(along))) / std::hypot(1, 0.5);
      EXPECT_LT(std::min(std::abs(from_side), std::abs(up)), 2.5) << along << ", " << up;
      ++red;
    } else if (b - std::max(r, g) > 80) {
      EXPECT_NEAR(std::abs(along), 150, 2.5) << up;
      EXPECT_LT(up, 2.5);
      ++blue;
    }
  }
  EXPECT_GT(red, 500);  // around the triangle
  EXPECT_GT(blue, 50);
}

// Half a pixel along an outline of 335 px is 0.75 % of its 22 500 px.
TEST(Overlay, APhotographInAFrameCoversItsSilhouette) {
  const fs::path folder = EmptyFolder("in_frame");
  const Experiment experiment = MeasureLeaning(folder);
  const MeasuredView& view = experiment.runs[0].views[0];
  const Frame& frame = experiment.aehp.frame;
  GrayImage dark =
      PhotoInFrame(ReadPhotograph(view.photo).image, view.plate, experiment.photo_pixel, frame);
  for (int y = 0; y < dark.height; ++y) {
    for (int x = 0; x < dark.width; ++x) {
      // The middle between the light, 225 at most, and a tenth of it.
      dark.at(x, y) = y < frame.baseline && dark.at(x, y) < 110 ? 0 : 255;
    }
  }
  EXPECT_LT(Sad(dark, experiment.runs[0].profile.image), 0.02 * Nebp(experiment.aehp.image));
}

}  // namespace overlay_test
}  // namespace talus::imaging
