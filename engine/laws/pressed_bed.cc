#include "engine/laws/pressed_bed.h"

#include <cmath>
#include <numbers>

namespace talus::engine {
namespace {

constexpr double kSolidFraction = 0.58;                    // φ [-]
constexpr double kContactsOfSolid = kSolidFraction * 4.5;  // φ Z [-]

}  // namespace

double PressedOverlap(const PairConstants& pair, double stress) {
  return std::pow(
      3 * std::numbers::sqrt2 * std::numbers::pi * stress / (kContactsOfSolid * pair.y_star),
      2.0 / 3);
}

double BedStress(double density, double gravity, double solid_volume) {
  return kSolidFraction * density * gravity * std::cbrt(solid_volume / kSolidFraction);
}

double AdhesiveStress(const PairConstants& pair, double radius) {
  const double force = pair.pull_off * radius / 2;
  return kContactsOfSolid * force / (4 * std::numbers::pi * radius * radius);
}

}  // namespace talus::engine
