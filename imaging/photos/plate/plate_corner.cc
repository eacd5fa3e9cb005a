#include "imaging/photos/plate/plate_corner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/line_fit.h"
#include "imaging/photos/plate/corner_fit.h"

namespace talus::imaging {
namespace {

// Next to a corner the picture is looked at in pixels, or in larger units where it is blurred: the
// blur rounds the corner.
constexpr double kUsualBlur = 1.5;  // in which a unit is a pixel
constexpr double kBelow = 6;        // start, below the end
constexpr int kCornerFrom = 2;      // distances from the side
constexpr int kCornerTo = 14;
constexpr double kHighest = 45;           // upwards
constexpr double kSteepest = 2.5;         // step between neighbours of one outline
constexpr std::size_t kFewestCorner = 4;  // neighbours that make an outline
constexpr double kFarthestCorner = 4;     // a corner farther from the end is something else
constexpr double kUsualBend = 0.9;        // of tan θ over the plate's width

double Unit(double blur) { return std::max(1.0, blur / kUsualBlur); }

// x inwards from the side, y up from `end`. Going up from inside the plate meets light at a bare
// top or at a slope; the first powder that stands off the line ends the search.
std::vector<EdgePoint> OutlineBeside(const TiltedView& tilted, const SideEnd& end) {
  const double unit = Unit(end.blur);
  const double below = kBelow * unit;
  std::vector<EdgePoint> outline;
  for (int distance = kCornerFrom; distance <= kCornerTo; ++distance) {
    const double inwards = distance * unit;
    const EdgePoint start = tilted.Point(end.point, -end.side * inwards, -below);
    const std::optional<double> way = tilted.DarkUntil(start, 0.5, kHighest * unit);
    if (!way) break;
    const double up = *way - below;
    if (!outline.empty() && std::abs(up - outline.back().y) > kSteepest * unit) break;
    outline.push_back({.x = inwards, .y = up});
  }
  return outline;
}

// y against max(x, shelf).
base::LineFit FitBeyond(const std::vector<EdgePoint>& points, double shelf) {
  base::LineFit fit;
  for (const EdgePoint& p : points) fit.Add(std::max(p.x, shelf), p.y);
  return fit;
}

// The bent line that is nearest to the outline, which the blur has rounded.
CornerGuess GuessCorner(const std::vector<EdgePoint>& outline) {
  double shelf = 0;
  base::LineFit best = FitBeyond(outline, shelf);
  for (std::size_t i = 1; i + 2 < outline.size(); ++i) {
    const base::LineFit fit = FitBeyond(outline, outline[i].x);
    if (fit.Slope() < 0 || fit.Squares() >= best.Squares()) continue;
    best = fit;
    shelf = outline[i].x;
  }
  const base::StraightLine line = best.Line();
  return {.slope_at_side = line.at_zero,
          .shelf = shelf,
          .slope = line.slope,
          .farthest = outline.back().x};
}

// Pixels near the side or the outline. As many units as pixels suffice where the picture is
// blurred: their neighbours show the same.
std::vector<SeenPixel> PixelsNear(const TiltedView& tilted, const SideEnd& end,
                                  const std::vector<EdgePoint>& outline) {
  const double below = kBelow * Unit(end.blur);
  const double band = 4 * end.blur + 1;
  std::vector<EdgePoint> edge = outline;
  for (double up = -below; up < outline.front().y; up += 1) edge.push_back({.x = 0, .y = up});
  double reach = 0;
  for (const EdgePoint& p : edge) reach = std::max(reach, std::hypot(p.x, p.y) + band);
  const auto is_near = [&](const SeenPixel& pixel) {
    return std::ranges::any_of(edge, [&](const EdgePoint& p) {
      return std::hypot(p.x - pixel.in, p.y - pixel.up) < band;
    });
  };
  const RelativeImage& image = tilted.image();
  const int stride = static_cast<int>(Unit(end.blur));
  const int last_x = std::min(image.width - 1, static_cast<int>(end.point.x + reach));
  const int last_y = std::min(image.height - 1, static_cast<int>(end.point.y + reach));
  std::vector<SeenPixel> pixels;
  for (int y = std::max(0, static_cast<int>(end.point.y - reach)); y <= last_y; y += stride) {
    for (int x = std::max(0, static_cast<int>(end.point.x - reach)); x <= last_x; x += stride) {
      const EdgePoint way = tilted.AsPlateLies(end.point, {.x = x + 0.5, .y = y + 0.5});
      const SeenPixel pixel{.in = -end.side * way.x, .up = way.y, .level = image.at(x, y)};
      if (pixel.in > outline.back().x || pixel.up < -below || !is_near(pixel)) continue;
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

}  // namespace

PlateCorner FindCorner(const TiltedView& tilted, const SideEnd& end) {
  const PlateCorner vague{.point = end.point, .sharp = false};
  const double unit = Unit(end.blur);
  const std::vector<EdgePoint> outline = OutlineBeside(tilted, end);
  if (outline.size() < kFewestCorner) return vague;
  CornerGuess guess = GuessCorner(outline);
  guess.blur = end.blur;
  guess.bend = kUsualBend / end.plate_width;
  guess.dark = tilted.At(tilted.Point(end.point, -end.side * kBelow * unit, -kBelow * unit));
  const std::optional<double> top = FitTop(PixelsNear(tilted, end, outline), guess);
  if (!top || std::abs(*top) > kFarthestCorner * unit) return vague;
  return {.point = tilted.Point(end.point, 0, *top), .sharp = true};
}

}  // namespace talus::imaging
