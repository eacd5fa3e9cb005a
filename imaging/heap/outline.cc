#include "imaging/heap/outline.h"

#include <algorithm>
#include <cmath>

namespace talus::imaging {
namespace {

// How far past the light neighbour's centre the level is crossed, in (0, 1].
double Crossing(double light, double dark, double level) {
  return (light - level) / (light - dark);
}

// Where the powder of a row begins; one column of white is thought left of the image.
double LeftEnd(const std::uint8_t* row, int column, double level) {
  const double light = column > 0 ? row[column - 1] : 255;
  return column - 0.5 + Crossing(light, row[column], level);
}

double RightEnd(const std::uint8_t* row, int column, int width, double level) {
  const double light = column + 1 < width ? row[column + 1] : 255;
  return column + 1.5 - Crossing(light, row[column], level);
}

}  // namespace

Outline FindOutline(const GrayImage& image, const Frame& frame, double level) {
  Outline outline;
  outline.height.assign(static_cast<std::size_t>(image.width), 0.0);
  const int last = std::min(image.height - 1, static_cast<int>(std::floor(frame.baseline - 0.5)));
  for (int y = last; y >= 0; --y) {
    const std::uint8_t* const row =
        &image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)];
    int first = -1;
    int end = -1;
    for (int x = 0; x < image.width; ++x) {
      if (row[x] >= level) continue;
      if (first < 0) first = x;
      end = x;
      const double light = y > 0 ? image.at(x, y - 1) : 255;
      if (light < level) continue;  // powder goes on above
      outline.height[static_cast<std::size_t>(x)] =
          frame.baseline - (y - 0.5 + Crossing(light, row[x], level));
    }
    if (first < 0) continue;
    outline.rows.push_back({.height = frame.baseline - y - 0.5,
                            .left = LeftEnd(row, first, level),
                            .right = RightEnd(row, end, image.width, level)});
  }
  return outline;
}

}  // namespace talus::imaging
