#include "experiments/rigs/phased/repose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/rigs/phased/spheres.h"
#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {
namespace {

constexpr double kPixelsPerGrain = 5;
constexpr int kMostPixels = 2000;  // across
constexpr double kLowest = 1.5;    // grains: a layer of single ones has no slope

// The whole plate and as much above it as the heap is high, with a margin.
imaging::Frame FrameOf(double top, const RoundPlate& plate) {
  constexpr double kMargin = 0.1;  // of the plate's diameter, on each side
  const double width = (1 + 2 * kMargin) * plate.diameter;
  imaging::Frame frame{
      .pixel_size = std::max(plate.grain_diameter / kPixelsPerGrain, width / kMostPixels),
      .plate_diameter = plate.diameter};
  frame.width = static_cast<int>(std::ceil(width / frame.pixel_size));
  frame.height = static_cast<int>(std::ceil((top + kMargin * plate.diameter) / frame.pixel_size));
  frame.center_x = 0.5 * frame.width;
  frame.baseline = frame.height - 1;
  return frame;
}

Reading ReadingOf(Observable observable, const imaging::Metric& metric) {
  Reading reading{observable};
  if (std::isfinite(metric.value.value)) {
    reading.value = metric.value.value;
  } else {
    reading.undefined = metric.value.not_defined;
  }
  return reading;
}

}  // namespace

std::vector<Reading> ReposeReadings(std::span<const engine::Particle> heap,
                                    const RoundPlate& plate) {
  const double top = TopOf(heap);
  const imaging::Frame frame = FrameOf(top, plate);
  imaging::HeapImages images;
  images.parts = imaging::ProjectViews(SpheresOf(heap), frame, imaging::kDefaultViews);
  images.profile = {.image = imaging::MeanImage(images.parts), .frame = frame};
  const std::vector<imaging::Metric> metrics = imaging::DescribeProfile(images);
  const std::pair<Observable, const char*> kMethods[] = {
      {Observable::kReposeAngle1, "repose_angle_1_mean_deg"},
      {Observable::kReposeAngle2, "repose_angle_2_mean_deg"},
      {Observable::kReposeAngle3, "repose_angle_3_mean_deg"},
      {Observable::kReposeTriangle, "triangle_angle_deg"},
      {Observable::kStaticCohesiveIndex, "static_cohesive_index"}};
  std::vector<Reading> readings;
  for (const auto& [observable, name] : kMethods) {
    readings.push_back(ReadingOf(observable, imaging::FindMetric(metrics, name)));
    const bool is_angle = observable != Observable::kStaticCohesiveIndex;
    if (!heap.empty() && !(top > 0)) {
      readings.back() = {.observable = observable, .undefined = "nothing stands above the rim"};
    } else if (is_angle && !heap.empty() && top <= kLowest * plate.grain_diameter) {
      readings.back() = {.observable = observable, .undefined = "the heap is one grain high"};
    }
  }
  return readings;
}

}  // namespace talus::rigs
