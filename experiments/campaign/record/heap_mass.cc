#include "experiments/campaign/record/heap_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "engine/scene/size_distribution.h"
#include "experiments/rigs/filling/pouring.h"

namespace talus::campaign {
namespace {

constexpr const char* kMoreThanFilled = "more_than_filled";  // AlarmKind::kMoreThanFilled

}  // namespace

double VolumeOfRevolution(const imaging::Profile& profile, double from) {
  const imaging::Frame& frame = profile.frame;
  const int base = std::min(
      frame.height, static_cast<int>(std::lround(frame.baseline - from / frame.pixel_size)));
  double volume = 0;
  for (int y = 0; y < base; ++y) {
    double width = 0;  // [px]
    for (int x = 0; x < frame.width; ++x) width += 1 - profile.image.at(x, y) / 255.0;
    volume += std::numbers::pi / 4 * width * width;
  }
  return volume * std::pow(frame.pixel_size, 3);
}

std::optional<journal::PhotoWarningRecord> MoreThanFilled(const rigs::Case& rig_case,
                                                          const imaging::Profile& aehp) {
  if (!rigs::IsRoundHeap(rig_case.rig.kind) || aehp.frame.num_pictures() > 1) return std::nullopt;
  // The outline passes over its highest grains, half a grain above what is filled.
  const double above = engine::SizeCurve(rig_case.powder.sizes).VolumeQuantile(0.5) / 2;
  const double least = rigs::kLooseSolidFraction * rig_case.powder.material.density *
                       VolumeOfRevolution(aehp, above);
  if (!(least > rig_case.powder.mass)) return std::nullopt;
  return journal::PhotoWarningRecord{
      .kind = kMoreThanFilled,
      .photo = {},
      .value = least / rig_case.powder.mass,
      .text = "the heap on the photographs would weigh " + base::PlainNumber(1e3 * least, 2) +
              " g, as loose as a solid fraction of " +
              base::ShortNumber(rigs::kLooseSolidFraction) + ", and " +
              base::PlainNumber(1e3 * rig_case.powder.mass, 2) +
              " g were filled in: the plate's diameter, the mass or the density is wrong, or this "
              "heap is looser still"};
}

}  // namespace talus::campaign
