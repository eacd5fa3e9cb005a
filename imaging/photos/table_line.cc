#include "imaging/photos/table_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/line_fit.h"

namespace talus::imaging {
namespace {

constexpr double kMostTilt = 0.09;      // slope of the table's top: a heap's are steeper
constexpr double kOnLine = 1.5;         // of an outline that is the table's top [px]
constexpr double kAboveLine = 2;        // of an outline that is something on it [px]
constexpr double kFewestOnLine = 0.15;  // of the picture's width
constexpr double kFewestDark = 0.95;    // of the lower border
constexpr int kWidestGap = 3;           // between columns of one heap [px]

// y of the outline's top in every column, NaN where the lower border is light.
std::vector<double> OutlineOf(const BacklitPhoto& photo) {
  const RelativeImage& image = photo.image;
  std::vector<double> outline(static_cast<std::size_t>(image.width), std::nan(""));
  for (int x = 0; x < image.width; ++x) {
    int y = image.height - 1;
    const auto level = [&](int row) { return image.at(x, row); };
    if (level(y) >= photo.threshold) continue;
    while (y > 0 && level(y - 1) < photo.threshold) --y;
    double top = y;
    if (y > 0) {
      const double dark = level(y);
      const double light = level(y - 1);
      top = y + 0.5 - (photo.threshold - dark) / (light - dark);
    }
    outline[static_cast<std::size_t>(x)] = top;
  }
  return outline;
}

int CountOn(const base::StraightLine& line, const std::vector<double>& outline) {
  int count = 0;
  for (std::size_t x = 0; x < outline.size(); ++x) {
    count += std::abs(outline[x] - line.At(static_cast<double>(x) + 0.5)) < kOnLine;
  }
  return count;
}

// Through the columns that lie on it already.
base::StraightLine Refit(const base::StraightLine& line, const std::vector<double>& outline) {
  base::LineFit fit;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double x = static_cast<double>(i) + 0.5;
    if (std::abs(outline[i] - line.At(x)) < kOnLine) fit.Add(x, outline[i]);
  }
  return fit.Line();
}

// The line through two columns that holds most of the others.
base::StraightLine BestLine(const std::vector<double>& outline) {
  constexpr int kTried = 48;  // columns
  base::StraightLine best;
  int most = 0;
  const double step = static_cast<double>(outline.size() - 1) / (kTried - 1);
  for (int i = 0; i < kTried; ++i) {
    for (int j = 0; j < i; ++j) {
      const auto a = static_cast<std::size_t>(j * step);
      const auto b = static_cast<std::size_t>(i * step);
      if (a == b) continue;
      const double slope = (outline[b] - outline[a]) / static_cast<double>(b - a);
      if (!(std::abs(slope) <= kMostTilt)) continue;
      const base::StraightLine line{.at_zero = outline[a] - slope * (static_cast<double>(a) + 0.5),
                                    .slope = slope};
      const int count = CountOn(line, outline);
      if (count <= most) continue;
      most = count;
      best = line;
    }
  }
  if (most < kFewestOnLine * static_cast<double>(outline.size())) return {.at_zero = std::nan("")};
  for (int round = 0; round < 3; ++round) best = Refit(best, outline);
  return best;
}

// What stands above the line, column by column, [from, to).
struct Heap {
  int from = 0;
  int to = 0;
  double area = 0;
};

Heap LargestAbove(const std::vector<double>& above) {
  Heap largest;
  Heap heap;
  for (int x = 0; x < static_cast<int>(above.size()); ++x) {
    const double height = above[static_cast<std::size_t>(x)];
    if (std::isnan(height) && x == heap.to) heap.to = x + 1;  // no gap: nothing is known of it
    if (!(height > kAboveLine)) continue;
    if (heap.area == 0 || x > heap.to + kWidestGap) heap = {.from = x, .to = x, .area = 0};
    heap.to = x + 1;
    heap.area += height;
    if (heap.area > largest.area) largest = heap;
  }
  return largest;
}

[[noreturn]] void ThrowNoTable(const std::string& name, const std::string& what) {
  throw base::ConfigError(
      name + ": " + what +
      "; with \"scale\" the heap stands on a dark table that reaches across the "
      "picture's lower border and is level to 5 degrees; take it so, or give "
      "its place with \"frame\"");
}

TableLine TableUnder(const std::vector<double>& outline, const std::string& name) {
  const auto dark =
      std::count_if(outline.begin(), outline.end(), [](double top) { return std::isfinite(top); });
  if (static_cast<double>(dark) < kFewestDark * static_cast<double>(outline.size())) {
    ThrowNoTable(name, "no table found: the picture's lower border is not dark");
  }
  const base::StraightLine line = BestLine(outline);
  if (std::isnan(line.at_zero)) ThrowNoTable(name, "no table found: no straight, level top");
  const double tilt = std::atan(line.slope);
  std::vector<double> above;
  for (std::size_t x = 0; x < outline.size(); ++x) {
    above.push_back((line.At(static_cast<double>(x) + 0.5) - outline[x]) * std::cos(tilt));
  }
  const Heap heap = LargestAbove(above);
  if (heap.area == 0) ThrowNoTable(name, "nothing stands on the table");
  // The middle of a column of a tilted heap stands beside its foot. A column that has no outline,
  // as one pixel of the lower border is light, is NaN, and counts as 0: so in this order.
  double moment = 0, area = 0;
  for (int x = heap.from; x < heap.to; ++x) {
    const double height = std::max(0.0, above[static_cast<std::size_t>(x)]);
    moment += height * (x + 0.5 - height / 2 * std::sin(tilt));
    area += height;
  }
  const double center = moment / area;
  if (!std::isfinite(center)) ThrowNoTable(name, "no middle found of what stands on the table");
  return {.center_x = center,
          .baseline = line.At(center),
          .tilt = tilt,
          .reach = std::max(center - heap.from, heap.to - center)};
}

}  // namespace

TableLine FindTable(const BacklitPhoto& photo, const std::string& name) {
  return TableUnder(OutlineOf(photo), name);
}

}  // namespace talus::imaging
