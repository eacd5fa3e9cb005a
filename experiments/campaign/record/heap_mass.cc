#include "experiments/campaign/record/heap_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text/plain_number.h"

namespace talus::campaign {
namespace {

constexpr const char* kMoreThanFilled = "more_than_filled";  // AlarmKind::kMoreThanFilled

}  // namespace

double VolumeOfRevolution(const imaging::Profile& profile) {
  const imaging::Frame& frame = profile.frame;
  const int base = std::min(frame.height, static_cast<int>(std::lround(frame.baseline)));
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
  constexpr double kLoose = 0.4;  // solid fraction; poured spheres have 0.55 to 0.6
  if (!rigs::IsRoundHeap(rig_case.rig.kind) || aehp.frame.num_pictures() > 1) return std::nullopt;
  const double least = kLoose * rig_case.powder.material.density * VolumeOfRevolution(aehp);
  if (!(least > rig_case.powder.mass)) return std::nullopt;
  return journal::PhotoWarningRecord{
      .kind = kMoreThanFilled,
      .photo = {},
      .value = least / rig_case.powder.mass,
      .text = "the heap on the photographs would weigh " + base::PlainNumber(1e3 * least, 2) +
              " g, as loose as a solid fraction of 0.4, and " +
              base::PlainNumber(1e3 * rig_case.powder.mass, 2) +
              " g were filled in: the plate's diameter, the mass or the density is wrong"};
}

}  // namespace talus::campaign
