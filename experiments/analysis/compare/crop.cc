#include "experiments/analysis/compare/crop.h"

#include <algorithm>
#include <cmath>

namespace talus::analysis {

Box HeapBox(const std::vector<const imaging::Profile*>& profiles) {
  constexpr double kMargin = 0.05;  // of the plate, each side
  const imaging::Frame& frame = profiles.front()->frame;
  const double plate = frame.plate_diameter / frame.pixel_size;  // [px]
  double left = frame.center_x - plate / 2;
  double right = frame.center_x + plate / 2;
  double top = frame.baseline - 0.1 * plate;
  for (const imaging::Profile* profile : profiles) {
    for (int y = 0; y < profile->image.height; ++y) {
      for (int x = 0; x < profile->image.width; ++x) {
        if (profile->image.at(x, y) >= 128) continue;
        left = std::min<double>(left, x);
        right = std::max<double>(right, x + 1);
        top = std::min<double>(top, y);
      }
    }
  }
  if (frame.num_pictures() > 1) {
    left = 0;
    right = frame.width;
  }
  const double margin = kMargin * plate;
  const int x0 = std::clamp(static_cast<int>(std::floor(left - margin)), 0, frame.width - 1);
  const int y0 = std::clamp(static_cast<int>(std::floor(top - margin)), 0, frame.height - 1);
  const int x1 = std::clamp(static_cast<int>(std::ceil(right + margin)), x0 + 1, frame.width);
  const int y1 =
      std::clamp(static_cast<int>(std::ceil(frame.baseline + margin)), y0 + 1, frame.height);
  return {.left = x0, .top = y0, .width = x1 - x0, .height = y1 - y0};
}

imaging::GrayImage Cropped(const imaging::GrayImage& image, const Box& box) {
  imaging::GrayImage cut{.width = box.width, .height = box.height, .pixels = {}};
  cut.pixels.reserve(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) cut.pixels.push_back(image.at(box.left + x, box.top + y));
  }
  return cut;
}

}  // namespace talus::analysis
