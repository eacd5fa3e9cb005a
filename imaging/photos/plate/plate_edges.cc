#include "imaging/photos/plate/plate_edges.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/median.h"
#include "imaging/photos/plate/edge_blur.h"
#include "imaging/photos/plate/plate_corner.h"
#include "imaging/photos/plate/side_lines.h"
#include "imaging/photos/plate/tilted_view.h"

namespace talus::imaging {
namespace {

constexpr double kNearLine = 1.0;         // how far a point of the lower edge may be from it [px]
constexpr std::size_t kFewestLower = 10;  // points that make a lower edge

// Down from the middle of the plate's sides, under every column.
std::vector<EdgePoint> FindLower(const TiltedView& tilted, const StraightSides& plate, int height) {
  std::vector<EdgePoint> lower;
  if (plate.last >= height - 3) return lower;
  const double row = (plate.first + plate.last + 1) / 2.0;
  const EdgePoint middle{.x = (plate.LeftAt(row) + plate.RightAt(row)) / 2, .y = row};
  const double half = plate.width() / 2 - 4;
  const double expected = plate.last + 1 - row;
  std::vector<EdgePoint> points;
  std::vector<double> ways;
  for (double along = -half; along <= half; along += 1) {
    const EdgePoint start = tilted.Point(middle, along, 0);
    const std::optional<double> way = tilted.DarkUntil(start, -0.5, expected + 6);
    if (!way) continue;
    ways.push_back(-*way);
    points.push_back(tilted.Point(start, 0, *way));
  }
  if (points.size() < kFewestLower) return lower;
  std::vector<double> sorted = ways;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double median = sorted[sorted.size() / 2];
  const double drift = 0.01 * plate.width();  // what the tilt of short sides may still be off
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(ways[i] - median) < kNearLine + drift) lower.push_back(points[i]);
  }
  if (lower.size() < kFewestLower) lower.clear();
  return lower;
}

// How bright a column of the plate is `up` from a point [-].
double BrightnessAt(const TiltedView& tilted, const EdgePoint& middle, double along, double up) {
  return tilted.At(tilted.Point(middle, along, up));
}

// By how much the grains are brighter than the plate [-], whose top is at `middle`, about. Holes
// between grains are not theirs: the median of the columns has none.
double StepOf(const TiltedView& tilted, const EdgePoint& middle, double width) {
  std::vector<double> steps;
  for (double along = -0.45 * width; along <= 0.45 * width; along += 1) {
    const auto at = [&](double up) { return BrightnessAt(tilted, middle, along, up); };
    if (at(6) < tilted.threshold()) steps.push_back((at(6) + at(7) - at(-6) - at(-7)) / 2);
  }
  return steps.empty() ? 0 : base::Median(steps);
}

// The light between the plate and the grains on it, in one column of the plate.
struct Gap {
  double light = 0;   // ∫ brightness dv, 1 = the background [px]: its thickness
  double moment = 0;  // ∫ brightness v dv [px²], v up from the middle that was guessed
};

// Nothing where the light is no narrow line in the dark. `step`: StepOf.
std::optional<Gap> FindGap(const TiltedView& tilted, const EdgePoint& middle, double along,
                           double step) {
  const auto at = [&](double up) { return BrightnessAt(tilted, middle, along, up); };
  const double between = (at(-7) + at(-6) + at(6) + at(7)) / 4;
  constexpr double kStep = 0.5;
  Gap gap;
  for (double up = -5; up <= 5; up += kStep) {
    const double dark = between + (up < 0 ? -step / 2 : up > 0 ? step / 2 : 0);
    const double light = (at(up) - dark) / (1 - dark) * kStep;
    gap.light += light;
    gap.moment += light * up;
  }
  constexpr double kThickest = 2;  // [px]
  return at(6) < tilted.threshold() && gap.light < kThickest ? std::optional(gap) : std::nullopt;
}

// Grains touch the plate in points, and light passes beside them, in a column up to its thickness a
// above the plate: its mean height is Σ a²/2 / Σ a. Columns are taken in groups, so that noise does
// not add to the squares.
std::optional<EdgePoint> FindSeam(const TiltedView& tilted, const EdgePoint& middle, double width) {
  constexpr double kGroup = 5;          // columns
  constexpr double kLeastLight = 0.03;  // mean thickness that is told from noise [px]
  constexpr double kFarthest = 3;       // from the guess, which knows the corners [px]
  const double step = StepOf(tilted, middle, width);
  double groups = 0, light = 0, moment = 0, squares = 0;
  for (double along = -0.45 * width; along <= 0.45 * width; along += kGroup) {
    Gap group;
    int columns = 0;
    for (double column = 0; column < kGroup; ++column) {
      const std::optional<Gap> gap = FindGap(tilted, middle, along + column, step);
      if (!gap) continue;
      ++columns;
      group.light += gap->light;
      group.moment += gap->moment;
    }
    if (columns < kGroup) continue;
    groups += 1;
    light += group.light / kGroup;
    moment += group.moment / kGroup;
    squares += group.light * group.light / kGroup / kGroup;
  }
  if (groups < 5 || light < kLeastLight * groups) return std::nullopt;
  // A step that is not where it was guessed counts as light, too.
  if (light < 2 * kFarthest * std::abs(step) * groups) return std::nullopt;
  const double up = moment / light - squares / 2 / light;
  return std::abs(up) < kFarthest ? std::optional(tilted.Point(middle, 0, up)) : std::nullopt;
}

const PlateSides& RequirePlate(const std::optional<PlateSides>& sides, const std::string& name) {
  if (sides && sides->is_cut) {
    throw base::ConfigError(
        name +
        ": the plate is cut by the picture's border, and only its pedestal has both sides; move "
        "the camera so that the whole plate is in the picture, give its place with \"frame\", or "
        "leave the photograph out");
  }
  if (sides) return *sides;
  throw base::ConfigError(
      name +
      ": no plate found (two straight parallel sides below the heap, clear of the image's border); "
      "check that the plate is in the picture and sharp, give its place with \"frame\", or leave "
      "the photograph out; a heap on a table without a plate needs a known length, such as two "
      "marks of a ruler, in pixels: --scale \"104,310-884,312=30 mm\" (\"scale\" in a spec)");
}

PlateEdges EdgesAlong(const BacklitPhoto& photo, const PlateSides& sides) {
  const StraightSides& plate = sides.straight;
  PlateEdges edges;
  edges.tilt = -std::atan(plate.slope);
  edges.width = plate.width() * std::cos(edges.tilt);
  for (int row = plate.first + kTrimmed; row <= plate.last - kTrimmed; ++row) {
    const SideEnds& ends = *sides.ends[static_cast<std::size_t>(row)];
    edges.left.push_back({.x = ends.left, .y = row + 0.5});
    edges.right.push_back({.x = ends.right, .y = row + 0.5});
  }
  const EdgePoint left{.x = plate.LeftAt(sides.left_top - 0.5), .y = sides.left_top};
  const EdgePoint right{.x = plate.RightAt(sides.right_top - 0.5), .y = sides.right_top};
  const EdgePoint middle{.x = (left.x + right.x) / 2, .y = (left.y + right.y) / 2};
  const TiltedView tilted(photo, edges.tilt);
  edges.lower = FindLower(tilted, plate, photo.image.height);
  edges.seam = FindSeam(tilted, middle, edges.width);
  const double blur = EdgeBlur(photo.image, plate);
  edges.top_left =
      FindCorner(tilted, {.point = left, .side = -1, .blur = blur, .plate_width = edges.width});
  edges.top_right =
      FindCorner(tilted, {.point = right, .side = +1, .blur = blur, .plate_width = edges.width});
  return edges;
}

}  // namespace

PlateEdges FindPlateEdges(const BacklitPhoto& photo, const std::string& name) {
  return EdgesAlong(photo, RequirePlate(FindPlateSides(photo), name));
}

}  // namespace talus::imaging
