// Folders of drawn photographs, and their experiments.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/photos/experiment.h"
#include "tests/error_in.h"
#include "tests/imaging/synthetic_photo.h"

namespace talus::imaging {

namespace fs = std::filesystem;

inline constexpr double kPlate = 0.01;  // [m]

inline Scene SmallScene() {
  return {.width = 420, .height = 220, .plate_depth = 30, .center_x = 210, .baseline = 165};
}

inline fs::path EmptyFolder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("experiment_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

inline std::string Name(int run, int view) {
  return "run" + std::to_string(run) + "_view" + std::to_string(view) + ".png";
}

inline ExperimentOptions Options(const fs::path& folder) {
  ExperimentOptions options;
  options.photos = folder;
  options.plate_diameter = kPlate;
  return options;
}

inline GrayImage Triangle(const Scene& scene, double slope = 0.5) {
  return PhotographOf(scene, [&](double x) { return slope * (150 - std::abs(x)); });
}

// As two photographs of one thing differ: in a grey level somewhere.
inline GrayImage TakenAgain(GrayImage photo, int times) {
  photo.pixels[static_cast<std::size_t>(times)] -= 1;
  return photo;
}

// Two runs of two views, all good; no two heaps are alike.
inline fs::path GoodFolder(const std::string& name) {
  const fs::path folder = EmptyFolder(name);
  static const GrayImage photos[] = {Triangle(SmallScene()), Triangle(SmallScene(), 0.51)};
  for (int run = 1; run <= 2; ++run) {
    for (int view = 0; view < 2; ++view) {
      WritePng(folder / Name(run, view), TakenAgain(photos[run - 1], 2 * run + view));
    }
  }
  return folder;
}

inline std::string ErrorOf(const ExperimentOptions& options) {
  return ErrorIn([&] { MeasureExperiment(options); });
}

}  // namespace talus::imaging
