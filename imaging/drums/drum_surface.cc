#include "imaging/drums/drum_surface.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/line_fit.h"
#include "imaging/drums/drum_bed.h"

namespace talus::imaging {
namespace {

constexpr double kHalf = 127.5;
constexpr double kFringe = 0.02;  // share of the powder beyond the bed's ends
constexpr int kFewestPoints = 8;  // of a line

// From half-way on: a sum of grey levels would take half of the camera's noise on light for powder,
// as a map has no level beyond white.
bool IsPowder(std::uint8_t level) { return level < 128; }

// The powder of each column [px], in the disc.
std::vector<double> ColumnPowder(const GrayImage& image) {
  std::vector<double> powder(static_cast<std::size_t>(image.width), 0.0);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      powder[static_cast<std::size_t>(x)] += IsPowder(image.at(x, y)) ? 1 : 0;
    }
  }
  return powder;
}

// The column below which `share` of the powder lies.
double Quantile(const std::vector<double>& powder, double share) {
  double total = 0;
  for (const double column : powder) total += column;
  double sum = 0;
  for (std::size_t x = 0; x < powder.size(); ++x) {
    sum += powder[x];
    if (sum >= share * total) return static_cast<double>(x) + 0.5;
  }
  return 0;
}

// From the disc's top down, where it becomes powder; nothing for a column that is all one.
std::optional<double> SurfaceRow(const DrumMap& map, int x) {
  const double across = x + 0.5 - map.circle.center_x;
  const double half = map.inner_radius * map.inner_radius - across * across;
  if (half <= 1) return std::nullopt;
  const int top = static_cast<int>(std::ceil(map.circle.center_y - std::sqrt(half))) + 1;
  const int bottom = static_cast<int>(map.circle.center_y + std::sqrt(half)) - 1;
  if (top < 0 || bottom >= map.image.height || map.image.at(x, top) < kHalf) return std::nullopt;
  for (int y = top + 1; y <= bottom; ++y) {
    const double dark = map.image.at(x, y);
    const double light = map.image.at(x, y - 1);
    if (dark < kHalf) return y + 0.5 - (kHalf - dark) / (light - dark);
  }
  return std::nullopt;
}

Measured LineAngle(const std::vector<DrumPoint>& points, double from, double to) {
  base::LineFit fit;
  for (const DrumPoint& p : points) {
    if (p.x >= from && p.x <= to) fit.Add(p.x, p.height);
  }
  if (fit.Count() < kFewestPoints) return {.not_defined = "the surface is too short"};
  return {.value = -std::atan(fit.Slope())};
}

// Share of a disc below a chord that is `depth` radii below its centre.
double SegmentShare(double depth) {
  return (std::acos(depth) - depth * std::sqrt(1 - depth * depth)) / std::numbers::pi;
}

// The share of the whole drum, whose ring hides what lies beyond `seen` radii, where powder under a
// flat surface fills this share of what is seen: the chord that bounds both is as deep in both.
double WholeFill(double fill_seen, double seen) {
  double deepest = 1, highest = -1;  // of the chord, in radii of what is seen
  while (deepest - highest > 1e-9) {
    const double middle = (deepest + highest) / 2;
    (SegmentShare(middle) > fill_seen ? highest : deepest) = middle;
  }
  return SegmentShare(seen * (deepest + highest) / 2);
}

}  // namespace

DrumSurface MeasureSurface(const DrumMap& map) {
  DrumSurface surface;
  DrumMap bed = map;
  bed.image = BedAlone(map.image);
  for (int x = 0; x < map.image.width; ++x) {
    const std::optional<double> row = SurfaceRow(bed, x);
    if (!row) continue;
    surface.points.push_back(
        {.x = x + 0.5 - map.circle.center_x, .height = map.circle.center_y - *row});
  }
  const std::vector<double> powder = ColumnPowder(bed.image);
  const double low = Quantile(powder, kFringe) - map.circle.center_x;
  const double high = Quantile(powder, 1 - kFringe) - map.circle.center_x;
  surface.slope_angle = LineAngle(surface.points, low + (high - low) / 4, high - (high - low) / 4);
  if (!surface.slope_angle.defined()) {
    surface.fill.not_defined = surface.slope_angle.not_defined;
    return surface;
  }
  double total = 0, pixels = 0;
  for (int y = 0; y < map.image.height; ++y) {
    for (int x = 0; x < map.image.width; ++x) {
      const double r = std::hypot(x + 0.5 - map.circle.center_x, y + 0.5 - map.circle.center_y);
      if (r > map.inner_radius) continue;
      pixels += 1;
      total += IsPowder(map.image.at(x, y)) ? 1 : 0;
    }
  }
  surface.fill.value = WholeFill(total / pixels, map.inner_radius / map.drum_radius);
  return surface;
}

}  // namespace talus::imaging
