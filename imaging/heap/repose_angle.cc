#include "imaging/heap/repose_angle.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "base/line_fit.h"
#include "imaging/heap/heap_alone.h"
#include "imaging/heap/heap_shape.h"

namespace talus::imaging {
namespace {

constexpr double kLowest = 3.0;   // a lower heap has no slope one could measure [px]
constexpr int kFewestPoints = 5;  // of a regression
// Half the views decide where the outline is, but a tenth of them that overhang is enough to make
// an angle meaningless.
constexpr double kOverhangLevel = 0.9 * 255;

std::string Pixels(double length) {
  std::ostringstream text;
  text.precision(3);
  text << length << " px";
  return text.str();
}

// −dh/dx of the least-squares line through the points with across >= from.
Measured Regression(const Slope& slope, double from) {
  base::LineFit fit;
  for (const SlopePoint& point : slope.points) {
    if (point.across >= from) fit.Add(point.across, point.height);
  }
  if (fit.Count() < kFewestPoints) return {.not_defined = "the slope is too short"};
  if (!(fit.Slope() < 0)) return {.not_defined = "the outline does not fall outwards"};
  return {.value = -std::atan(fit.Slope())};
}

// The angle of one side by one method (0, 1, 2).
Measured SideAngle(const HeapShape& shape, const Slope& slope, std::size_t method,
                   const ReposeOptions& options) {
  if (method == 0 && slope.foot > 0) return {.value = std::atan(shape.height / slope.foot)};
  if (!(slope.foot - slope.shoulder > 0)) return {.not_defined = "there is no slope on this side"};
  const double share = method == 1 ? 1.0 : options.base_fraction;
  return Regression(slope, slope.foot - share * (slope.foot - slope.shoulder));
}

Measured MeanOf(const Measured& left, const Measured& right) {
  if (!left.defined()) return {.not_defined = "left: " + left.not_defined};
  if (!right.defined()) return {.not_defined = "right: " + right.not_defined};
  return {.value = (left.value + right.value) / 2};
}

ReposeAngles NoAngles(const std::string& because) {
  SideAngles none{.left = Measured{.not_defined = because},
                  .right = Measured{.not_defined = because},
                  .mean = Measured{.not_defined = because}};
  return {none, none, none};
}

Measured* Part(SideAngles& angles, int part) {
  return part == 0 ? &angles.left : part == 1 ? &angles.right : &angles.mean;
}

}  // namespace

void ReposeOptions::Validate(base::Problems& problems) const {
  problems.Require(base_fraction > 0 && base_fraction <= 1, "base_fraction", base_fraction,
                   "must be in (0, 1]");
  problems.Require(overhang_tolerance >= 0 && overhang_tolerance <= 1, "overhang_tolerance",
                   overhang_tolerance, "must be in [0, 1]");
}

ReposeAngles MeasureRepose(const GrayImage& image, const Frame& frame,
                           const ReposeOptions& options) {
  if (frame.num_pictures() > 1) return NoAngles("a film shows another heap in each picture");
  const GrayImage heap = HeapAlone(image, frame);
  const Outline outline = FindOutline(heap, frame);
  if (outline.empty()) return NoAngles("the heap is empty");
  const Outline few = FindOutline(heap, frame, kOverhangLevel);
  const Overhang overhang = WorstOverhang(outline, few);
  const double tolerance = options.overhang_tolerance * frame.plate_diameter / frame.pixel_size;
  const HeapShape shape = FindHeapShape(outline);
  if (!(shape.height >= kLowest)) {
    return NoAngles("the heap is only " + Pixels(shape.height) + " high");
  }
  const auto side = [&](const Slope& slope, double step, std::size_t method) {
    if (step > tolerance) return Measured{.not_defined = "the heap overhangs by " + Pixels(step)};
    return SideAngle(shape, slope, method, options);
  };
  ReposeAngles angles;
  for (std::size_t method = 0; method < angles.size(); ++method) {
    SideAngles& sides = angles[method];
    sides.left = side(shape.left, overhang.left, method);
    sides.right = side(shape.right, overhang.right, method);
    sides.mean = MeanOf(sides.left, sides.right);
  }
  return angles;
}

ReposeAngles MeasureRepose(const Profile& profile, std::span<const GrayImage> parts,
                           const ReposeOptions& options) {
  ReposeAngles angles = MeasureRepose(profile.image, profile.frame, options);
  std::vector<ReposeAngles> each;
  for (const GrayImage& part : parts) {
    each.push_back(MeasureRepose(part, profile.frame, options));
  }
  for (std::size_t method = 0; method < angles.size(); ++method) {
    for (int part = 0; part < 3; ++part) {
      std::vector<double> values;
      for (ReposeAngles& one : each) {
        const Measured& measured = *Part(one[method], part);
        if (measured.defined()) values.push_back(measured.value);
      }
      Part(angles[method], part)->standard_error = StandardError(values);
    }
  }
  return angles;
}

}  // namespace talus::imaging
