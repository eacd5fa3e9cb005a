#include "experiments/trials/engines/grain_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/sphere.h"
#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "imaging/spheres/coincident.h"

namespace talus::trials {
namespace {

constexpr double kSizeFactor = 1.5;  // a median of few grains of a wide distribution scatters
constexpr double kMassFactor = 1.2;
constexpr double kCoincidentShare = 0.01;

double TotalVolume(std::span<const base::Sphere> spheres) {
  double total = 0;
  for (const base::Sphere& sphere : spheres) total += base::SphereVolume(sphere.radius);
  return total;
}

double MedianDiameter(std::span<const base::Sphere> spheres) {
  std::vector<double> radii;
  for (const base::Sphere& sphere : spheres) radii.push_back(sphere.radius);
  std::ranges::sort(radii);
  double left = 0.5 * TotalVolume(spheres);
  for (const double radius : radii) {
    left -= base::SphereVolume(radius);
    if (left <= 0) return 2 * radius;
  }
  return radii.empty() ? 0 : 2 * radii.back();
}

// 10, 100, 1000 or one over these, to a tenth.
bool IsUnitSlip(double ratio) {
  const double power = std::log10(ratio);
  const double whole = std::round(power);
  return std::abs(whole) >= 1 && std::abs(whole) <= 3 && std::abs(power - whole) < std::log10(1.1);
}

std::string TimesText(double ratio) {
  return ratio >= 1 ? base::PlainNumber(ratio, 2) + " times as large"
                    : "1/" + base::PlainNumber(1 / ratio, 2) + " of that";
}

}  // namespace

std::optional<GrainDoubt> DoubtOfGrains(const rigs::Case& rig_case,
                                        std::span<const base::Sphere> spheres) {
  if (spheres.empty()) return std::nullopt;
  const double median = MedianDiameter(spheres);
  const double expected = rigs::EstimatePowder(rig_case).mean_diameter;
  const double ratio = median / expected;
  if (!(ratio < kSizeFactor && ratio > 1 / kSizeFactor)) {
    const std::string text = "grains of " + base::ShortNumber(median) +
                             " m, the median by volume, and those of the spec are of " +
                             base::ShortNumber(expected) +
                             " m at this scale factor: " + TimesText(ratio);
    if (IsUnitSlip(ratio)) {
      return GrainDoubt{.is_unit_slip = true,
                        .text = text +
                                "; is engine.length_unit right, and each length of the deck "
                                "in the deck's unit?"};
    }
    return GrainDoubt{.text = text +
                              "; does the deck take {{ mean_diameter }}, or the grains' "
                              "own section?"};
  }
  const std::size_t coincident = imaging::NumCoincident(spheres);
  if (static_cast<double>(coincident) > kCoincidentShare * static_cast<double>(spheres.size())) {
    return GrainDoubt{.text = base::Counted(static_cast<long long>(coincident), "grain") + " of " +
                              std::to_string(spheres.size()) +
                              " inside another; does the file hold several moments, or each grain "
                              "twice?"};
  }
  const double mass = TotalVolume(spheres) * rig_case.powder.material.density;
  if (!(mass > kMassFactor * rig_case.powder.mass)) return std::nullopt;
  return GrainDoubt{.text = "grains of " + base::ShortNumber(mass) +
                            " kg at the spec's density, and its powder has " +
                            base::ShortNumber(rig_case.powder.mass) +
                            " kg; does the deck take {{ num_grains }} or {{ mass }}?"};
}

}  // namespace talus::trials
