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

double Middle(double at, double inner, double outer) {
  return std::abs(outer - inner) > kStrip ? (inner + outer) / 2 : at;
}

// Adds the row at this height, as wide as the columns that reach it, if any do.
void AddRow(double height, Outline& outline) {
  const auto reaches = [height](double h) { return h >= height; };
  const auto first = std::ranges::find_if(outline.height, reaches);
  if (first == outline.height.end()) return;
  const auto last = std::find_if(outline.height.rbegin(), outline.height.rend(), reaches).base();
  outline.rows.push_back({.height = height,
                          .left = static_cast<double>(first - outline.height.begin()),
                          .right = static_cast<double>(last - outline.height.begin())});
}

// The outline at the level, but where those of the darker and the lighter side are a strip apart:
// there it goes through the strip's middle.
Outline Between(const Outline& inner, const Outline& at, const Outline& outer) {
  Outline outline{.height = at.height, .rows = {}};
  for (std::size_t x = 0; x < outline.height.size(); ++x) {
    outline.height[x] = Middle(at.height[x], inner.height[x], outer.height[x]);
  }
  const auto row_of = [](const Outline& one, double height) {
    return std::ranges::find(one.rows, height, &RowExtent::height);
  };
  for (const RowExtent& row : outer.rows) {
    const auto inner_row = row_of(inner, row.height);
    if (inner_row == inner.rows.end()) {  // none of the lower heaps is as high
      AddRow(row.height, outline);
      continue;
    }
    const RowExtent& at_row = *row_of(at, row.height);
    outline.rows.push_back({.height = row.height,
                            .left = Middle(at_row.left, inner_row->left, row.left),
                            .right = Middle(at_row.right, inner_row->right, row.right)});
  }
  return outline;
}

}  // namespace

// Half of an even number of silhouettes have powder over a whole strip, half-way between dark and
// light, rounded up or down: the outline of the lower or of the higher heaps would be its one side.
Outline FindOutline(const GrayImage& image, const Frame& frame, double level) {
  const Outline at = OutlineAt(image, frame, level);
  const auto has = [&](double low, double high) {
    return std::ranges::any_of(image.pixels, [&](std::uint8_t g) { return g >= low && g < high; });
  };
  const bool below = has(level - 1, level);
  const bool above = has(level, level + 1);
  if (!below && !above) return at;
  return Between(below ? OutlineAt(image, frame, level - 1) : at, at,
                 above ? OutlineAt(image, frame, level + 1) : at);
}

}  // namespace talus::imaging
