#include "imaging/heap/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "base/error.h"
#include "base/units.h"
#include "imaging/heap/heap_alone.h"
#include "imaging/heap/heap_shape.h"
#include "imaging/heap/outline.h"

namespace talus::imaging {
namespace {

constexpr const char* kFilm = "a film shows another heap in each picture";

Measured InDegrees(Measured angle) {
  angle.value /= base::kDegree;
  angle.standard_error /= base::kDegree;
  return angle;
}

double SquareMillimetres(double pixels, const Frame& frame) {
  const double pixel = frame.pixel_size * 1e3;  // [mm]
  return pixels * pixel * pixel;
}

Measured Iou(const GrayImage& a, const GrayImage& b) {
  double both = 0;
  double either = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    both += 255 - std::max(a.pixels[i], b.pixels[i]);
    either += 255 - std::min(a.pixels[i], b.pixels[i]);
  }
  return either > 0 ? Measured{.value = both / either}
                    : Measured{.not_defined = "both heaps are empty"};
}

// On a table the heap without the grains beside it, elsewhere the profile itself: a plate's loose
// grains count as powder of its area.
Profile OnItsBase(const Profile& profile) {
  if (!profile.frame.on_table()) return profile;
  return {.image = HeapAlone(profile.image, profile.frame), .frame = profile.frame};
}

// What the triangle stands on [px] from the left edge of the image.
struct Base {
  double middle = 0;
  double width = 0;
};

// The plate; on a table, which ends nowhere, from foot to foot of the heap, whose outline is not
// empty.
Base BaseOf(const Profile& profile, const Outline& outline) {
  const Frame& frame = profile.frame;
  if (!frame.on_table()) {
    return {.middle = frame.center_x, .width = frame.plate_diameter / frame.pixel_size};
  }
  const HeapShape shape = FindHeapShape(outline);
  return {.middle = shape.axis + (shape.right.foot - shape.left.foot) / 2,
          .width = shape.left.foot + shape.right.foot};
}

Measured TriangleAngle(const Profile& whole) {
  if (whole.frame.num_pictures() > 1) return {.not_defined = kFilm};
  const Profile profile = OnItsBase(whole);
  const double area = Nebp(profile.image);
  const Outline outline = FindOutline(profile.image, profile.frame);
  if (!(area > 0) || (profile.frame.on_table() && outline.empty())) {
    return {.not_defined = "the heap is empty"};
  }
  const double base = BaseOf(profile, outline).width;
  return {.value = std::atan(4 * area / (base * base))};
}

Measured CohesiveIndex(const Profile& whole) {
  if (whole.frame.num_pictures() > 1) return {.not_defined = kFilm};
  const Profile profile = OnItsBase(whole);
  const Outline outline = FindOutline(profile.image, profile.frame);
  if (outline.empty()) return {.not_defined = "the heap is empty"};
  double area = 0;
  for (const double height : outline.height) area += height;
  const Base base = BaseOf(profile, outline);
  const double half_base = base.width / 2;
  const double top = area / half_base;  // height of the triangle of the outline's area
  double deviation = 0;
  for (std::size_t i = 0; i < outline.height.size(); ++i) {
    const double across = std::abs(static_cast<double>(i) + 0.5 - base.middle);
    const double triangle = top * std::max(1 - across / half_base, 0.0);
    deviation += std::abs(outline.height[i] - triangle);
  }
  return {.value = deviation / area};
}

struct Named {
  std::string name;
  std::string unit;
  Measured value;
};

// What one heap alone has, in the order of the list.
std::vector<Named> Describe(const HeapImages& heap, const MetricOptions& options) {
  const Profile& profile = heap.profile;
  const double nebp = Nebp(profile.image);
  std::vector<Named> list{
      {"nebp_px", "px", Measured{.value = nebp}},
      {"nebp_mm2", "mm2", Measured{.value = SquareMillimetres(nebp, profile.frame)}}};
  const ReposeAngles angles = MeasureRepose(profile, heap.parts, options.repose);
  for (std::size_t method = 0; method < angles.size(); ++method) {
    const std::string name = "repose_angle_" + std::to_string(method + 1) + "_";
    list.push_back({name + "left_deg", "deg", InDegrees(angles[method].left)});
    list.push_back({name + "right_deg", "deg", InDegrees(angles[method].right)});
    list.push_back({name + "mean_deg", "deg", InDegrees(angles[method].mean)});
  }
  list.push_back({"triangle_angle_deg", "deg", InDegrees(TriangleAngle(profile))});
  list.push_back({"static_cohesive_index", "-", CohesiveIndex(profile)});
  return list;
}

// What compares two.
std::vector<Metric> Differences(const Profile& heap, const Profile& reference,
                                const MetricOptions& options) {
  const double sad = Sad(heap.image, reference.image);
  const double nebp = Nebp(reference.image);
  const Measured relative = nebp > 0 ? Measured{.value = sad / nebp}
                                     : Measured{.not_defined = "the reference heap is empty"};
  return {
      {"sad_mm2", "mm2", Measured{.value = SquareMillimetres(sad, heap.frame)},
       Measured{.value = 0}},
      {"sad_relative", "-", relative, Measured{.value = 0}},
      {"sad_px", "px", Measured{.value = sad}, Measured{.value = 0}},
      {"rmse_gray", "gray", Rmse(heap, reference.image, options.rmse_region), Measured{.value = 0}},
      {"iou", "-", Iou(heap.image, reference.image), Measured{.value = 1}}};
}

std::string SizeText(const GrayImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " px";
}

void Validate(const Profile& profile, base::Problems& problems) {
  const GrayImage& image = profile.image;
  const Frame& frame = profile.frame;
  problems.Within("frame", [&] { frame.Validate(problems); });
  const std::size_t num_pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  problems.Require(image.width == frame.width && image.height == frame.height &&
                       image.pixels.size() == num_pixels,
                   "image", "has " + SizeText(image) + ", which must be its frame's");
}

std::string FrameText(const Frame& frame) {
  std::ostringstream text;
  text.precision(10);
  if (frame.num_pictures() > 1) text << frame.num_pictures() << " pictures in ";
  text << frame.width << " x " << frame.height << " px of " << frame.pixel_size
       << " m, plate centre at column " << frame.center_x << ", baseline at row " << frame.baseline;
  return text.str();
}

}  // namespace

void Region::Validate(base::Problems& problems) const {
  problems.Require(left >= 0, "left_px", left, "must not be negative");
  problems.Require(top >= 0, "top_px", top, "must not be negative");
  problems.Require(width > 0, "width_px", width, "must be positive");
  problems.Require(height > 0, "height_px", height, "must be positive");
}

bool Region::IsWithin(const Frame& frame) const {
  return left <= frame.picture_width() - width && top <= frame.height - height;
}

double Nebp(const GrayImage& image) {
  std::int64_t sum = 0;
  for (const std::uint8_t level : image.pixels) sum += 255 - level;
  return static_cast<double>(sum) / 255;
}

double Sad(const GrayImage& a, const GrayImage& b) {
  if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size()) {
    throw base::ConfigError("the two images cannot be compared pixel by pixel: one has " +
                            SizeText(a) + ", the other " + SizeText(b));
  }
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return static_cast<double>(sum) / 255;
}

Measured Rmse(const Profile& heap, const GrayImage& reference,
              const std::optional<Region>& region) {
  const int width = heap.frame.picture_width(), height = heap.frame.height;
  const Region where =
      region.value_or(Region{.left = 0, .top = 0, .width = width, .height = height});
  if (!where.IsWithin(heap.frame)) {
    return {.not_defined = "the region is not within the image"};
  }
  double squares = 0;
  for (int picture = 0; picture < heap.frame.num_pictures(); ++picture) {
    const int left = picture * width + where.left;
    for (int y = where.top; y < where.top + where.height; ++y) {
      for (int x = left; x < left + where.width; ++x) {
        const double difference = heap.image.at(x, y) - reference.at(x, y);
        squares += difference * difference;
      }
    }
  }
  return {.value = std::sqrt(squares / heap.frame.num_pictures() / where.width / where.height)};
}

void RequireSameFrame(const Frame& a, const Frame& b) {
  const auto close = [](double x, double y, double tolerance) {
    return std::abs(x - y) <= tolerance;
  };
  if (a.width == b.width && a.height == b.height && a.num_pictures() == b.num_pictures() &&
      close(a.pixel_size, b.pixel_size, 1e-6 * b.pixel_size) &&
      close(a.center_x, b.center_x, 1e-3) && close(a.baseline, b.baseline, 1e-3)) {
    return;
  }
  throw base::ConfigError("the two profiles cannot be compared pixel by pixel: one has " +
                          FrameText(a) + ", the other " + FrameText(b) +
                          "; project the heap in the frame of the AEHP");
}

std::vector<Metric> DescribeProfile(const HeapImages& heap, const MetricOptions& options) {
  std::vector<Metric> metrics;
  for (Named& own : Describe(heap, options)) {
    metrics.push_back({std::move(own.name), std::move(own.unit), std::move(own.value),
                       Measured{.not_defined = "there is no reference"}});
  }
  return metrics;
}

std::vector<Metric> CompareProfiles(const HeapImages& heap, const HeapImages& reference,
                                    const MetricOptions& options) {
  RequireSameFrame(heap.profile.frame, reference.profile.frame);
  base::Problems problems;
  problems.Within("heap", [&] { Validate(heap.profile, problems); });
  problems.Within("reference", [&] { Validate(reference.profile, problems); });
  problems.ThrowIfAny();
  std::vector<Metric> metrics = Differences(heap.profile, reference.profile, options);
  std::vector<Named> own = Describe(heap, options);
  std::vector<Named> other = Describe(reference, options);
  for (std::size_t i = 0; i < own.size(); ++i) {
    metrics.push_back({std::move(own[i].name), std::move(own[i].unit), std::move(own[i].value),
                       std::move(other[i].value)});
  }
  return metrics;
}

std::vector<std::string> MetricNames() {
  const Frame frame{.width = 1, .height = 1, .pixel_size = 1e-3, .baseline = 1};
  const HeapImages empty{
      .profile = {.image = {.width = 1, .height = 1, .pixels = {255}}, .frame = frame},
      .parts = {}};
  std::vector<std::string> names;
  for (const Metric& metric : CompareProfiles(empty, empty)) names.push_back(metric.name);
  return names;
}

const Metric& FindMetric(const std::vector<Metric>& metrics, const std::string& name) {
  for (const Metric& metric : metrics) {
    if (metric.name == name) return metric;
  }
  throw base::ConfigError("\"" + name + "\" is not the name of one of the " +
                          std::to_string(metrics.size()) + " metrics");
}

}  // namespace talus::imaging
