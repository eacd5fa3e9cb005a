#include "experiments/campaign/record/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/units.h"

namespace talus::campaign {
namespace {

constexpr double kSideMargin = 0.15;  // of the plate diameter, on either side of the powder
constexpr double kTopMargin = 0.25;   // of the plate diameter, above the powder

// The bounding box of the experiment's powder above the plate, widened by the margins. A heap that
// leaves it is so far off that its exact shape does not matter; its metrics are of the whole image.
// All pictures of a film have it at one place, by columns of the first.
imaging::Region RegionThatMatters(const imaging::Profile& aehp) {
  const imaging::Frame& frame = aehp.frame;
  const int bottom = std::clamp(static_cast<int>(std::ceil(frame.baseline)), 1, frame.height);
  int left = frame.picture_width();
  int right = 0;
  int top = bottom - 1;
  for (int y = 0; y < bottom; ++y) {
    for (int column = 0; column < frame.width; ++column) {
      if (aehp.image.at(column, y) == 255) continue;
      const int x = column % frame.picture_width();
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
    }
  }
  if (left >= right) throw base::ConfigError("experiment: shows no powder above the plate");
  const double plate = frame.plate_diameter / frame.pixel_size;  // [px]
  const int side = static_cast<int>(std::ceil(kSideMargin * plate));
  left = std::max(0, left - side);
  right = std::min(frame.picture_width(), right + side);
  top = std::max(0, top - static_cast<int>(std::ceil(kTopMargin * plate)));
  return {.left = left, .top = top, .width = right - left, .height = bottom - top};
}

// The method of an angle of repose, 1 to 3.
int MethodOf(journal::Objective objective) {
  return 1 + static_cast<int>(objective) - static_cast<int>(journal::Objective::kAor1);
}

}  // namespace

Reference::Reference(std::optional<imaging::Profile> aehp, ReferenceOptions options)
    : has_image_(aehp.has_value()), options_(std::move(options)) {
  if (!aehp) return;
  aehp_.profile = std::move(*aehp);
  region_ = RegionThatMatters(aehp_.profile);
  if (!info().is_angle) return;
  const imaging::Measured angle = AngleOf(aehp_.profile.image);
  if (!angle.defined()) {
    throw base::ConfigError("objective: the experiment's " + std::string(info().key) +
                            " is not defined, because " + angle.not_defined +
                            "; use \"sad\" or \"rmse\"");
  }
  angle_ = angle.value;
}

imaging::Measured Reference::AngleOf(const imaging::GrayImage& image) const {
  const auto angles = imaging::MeasureRepose(image, aehp_.profile.frame, options_.metrics.repose);
  imaging::Measured angle =
      angles.at(static_cast<std::size_t>(MethodOf(options_.objective)) - 1).mean;
  angle.value /= base::kDegree;
  return angle;
}

std::vector<journal::MetricRecord> Reference::Measure(const imaging::GrayImage& profile) const {
  std::vector<journal::MetricRecord> records;
  if (!has_image_) return records;
  const imaging::HeapImages heap{.profile = {.image = profile, .frame = aehp_.profile.frame},
                                 .parts = {}};
  for (const imaging::Metric& metric : imaging::CompareProfiles(heap, aehp_, options_.metrics)) {
    records.push_back({.name = metric.name,
                       .value = metric.value.value,
                       .unit = metric.unit,
                       .undefined = metric.value.not_defined});
  }
  return records;
}

int Reference::NumViews() const {
  const std::vector<std::uint8_t>& pixels = aehp_.profile.image.pixels;
  const std::set<std::uint8_t> levels(pixels.begin(), pixels.end());
  return std::max(1, static_cast<int>(levels.size()) - 1);
}

bool Reference::IsMeasured(const journal::TrialRecord& trial) const {
  if (has_image_) {
    return trial.Metric(journal::InfoOf(journal::Objective::kSad).metric).has_value();
  }
  return std::any_of(scalars().begin(), scalars().end(), [&](const journal::ScalarRecord& scalar) {
    return trial.Metric(scalar.name).has_value();
  });
}

std::optional<double> Reference::Value(const journal::TrialRecord& trial) const {
  if (!has_image_) return std::nullopt;
  const std::optional<double> value = trial.Metric(info().metric);
  if (!value) return value;
  return info().Value(*value, angle_);
}

template <class Body>
void Reference::ForEachPixel(Body&& body) const {
  const imaging::Frame& frame = aehp_.profile.frame;
  for (int y = region_.top; y < region_.top + region_.height; ++y) {
    for (int start = region_.left; start < frame.width; start += frame.picture_width()) {
      for (int x = start; x < start + region_.width; ++x) body(x, y);
    }
  }
}

std::vector<float> Reference::Field(const imaging::GrayImage& profile) const {
  std::vector<float> field;
  ForEachPixel(
      [&](int x, int y) { field.push_back(static_cast<float>(255 - profile.at(x, y)) / 255.0F); });
  return field;
}

optimizer::FieldObjective Reference::MakeFieldObjective() const {
  if (!has_image_) return {};
  const double pixel_mm = 1e3 * aehp_.profile.frame.pixel_size;
  optimizer::FieldObjective objective{.width = region_.width * aehp_.profile.frame.num_pictures(),
                                      .height = region_.height,
                                      .target = Field(aehp_.profile.image),
                                      .sad_scale = pixel_mm * pixel_mm,
                                      .metric = {},
                                      .num_target_heaps = options_.num_heaps};
  if (options_.objective != journal::Objective::kSad) {
    objective.metric = [self = *this](std::span<const float> field) {
      return self.ValueOfField(field);
    };
  }
  return objective;
}

imaging::GrayImage Reference::ImageOf(std::span<const float> field) const {
  imaging::GrayImage image{
      .width = aehp_.profile.frame.width, .height = aehp_.profile.frame.height, .pixels = {}};
  image.pixels.assign(aehp_.profile.image.pixels.size(), 255);
  std::size_t i = 0;
  ForEachPixel([&](int x, int y) {
    const float powder = std::clamp(field[i++], 0.0F, 1.0F);
    image.at(x, y) = static_cast<std::uint8_t>(255 * (1 - powder) + 0.5F);  // rounded
  });
  return image;
}

// The objective of a predicted field, as it would be measured on its image. Only what is asked for
// is measured, since a search asks thousands of times.
double Reference::ValueOfField(std::span<const float> field) const {
  const imaging::GrayImage image = ImageOf(field);
  if (info().is_angle) {
    const imaging::Measured angle = AngleOf(image);
    return angle.defined() ? std::abs(angle.value - angle_) : kWorstAngle;
  }
  return imaging::Rmse({.image = image, .frame = aehp_.profile.frame}, aehp_.profile.image,
                       options_.metrics.rmse_region)
      .value;
}

const journal::TrialRecord* BestOfSearch(std::span<const journal::TrialRecord> trials,
                                         const Reference& reference, int experiment,
                                         double scale_factor) {
  const journal::TrialRecord* best = nullptr;
  double least = 0;
  for (const journal::TrialRecord& trial : trials) {
    const bool is_asked = trial.IsOfSearch() && trial.experiment == experiment &&
                          trial.scale_factor == scale_factor &&
                          trial.status == journal::TrialStatus::kOk;
    const auto value = is_asked ? reference.Value(trial) : std::nullopt;
    if (!value || (best != nullptr && *value >= least)) continue;
    best = &trial;
    least = *value;
  }
  return best;
}

}  // namespace talus::campaign
