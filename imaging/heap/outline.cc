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

Outline OutlineAt(const GrayImage& image, const Frame& frame, double level) {
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

constexpr double kStrip = 1;  // [px]: two outlines farther apart have a strip of one grey between

double Middle(double at, double beyond) {
  return std::abs(beyond - at) > kStrip ? (at + beyond) / 2 : at;
}

// Whether a row of `beyond` above all of the outline's still is as high as its columns.
void AddRow(double height, Outline& outline) {
  const auto reaches = [height](double h) { return h >= height; };
  const auto first = std::ranges::find_if(outline.height, reaches);
  if (first == outline.height.end()) return;
  const auto last = std::find_if(outline.height.rbegin(), outline.height.rend(), reaches).base();
  outline.rows.push_back({.height = height,
                          .left = static_cast<double>(first - outline.height.begin()),
                          .right = static_cast<double>(last - outline.height.begin())});
}

// `beyond` is that of the next grey level: the outline goes through the middle of what is between.
void MoveToMiddle(const Outline& beyond, Outline& outline) {
  for (std::size_t x = 0; x < outline.height.size(); ++x) {
    outline.height[x] = Middle(outline.height[x], beyond.height[x]);
  }
  auto row = outline.rows.begin();
  const double top = outline.rows.empty() ? 0 : outline.rows.back().height;
  for (const RowExtent& other : beyond.rows) {
    if (other.height > top) {
      AddRow(other.height, outline);
      row = outline.rows.begin();
      continue;
    }
    while (row != outline.rows.end() && row->height < other.height) ++row;
    if (row == outline.rows.end() || row->height != other.height) continue;
    row->left = Middle(row->left, other.left);
    row->right = Middle(row->right, other.right);
  }
}

}  // namespace

// Of an even number of silhouettes half have powder over a whole strip, half-way between dark and
// light: the outline of the lower heaps would be its one side.
Outline FindOutline(const GrayImage& image, const Frame& frame, double level) {
  Outline outline = OutlineAt(image, frame, level);
  const auto is_at_level = [level](std::uint8_t g) { return g >= level && g < level + 1; };
  if (std::ranges::any_of(image.pixels, is_at_level)) {
    MoveToMiddle(OutlineAt(image, frame, level + 1), outline);
  }
  return outline;
}

}  // namespace talus::imaging
