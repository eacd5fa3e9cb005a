#include "engine/laws/rolling_step.h"

#include <cmath>
#include <limits>

#include "base/sphere.h"
#include "engine/laws/pressed_bed.h"

namespace talus::engine {

double DampedShare(const PairConstants& pair, const BedGrains& grains, double dt) {
  const double r = grains.radius;
  const double mass = grains.density * base::SphereVolume(r);
  const double i_star = 0.7 * mass * r * r;
  const double stress = grains.stress + AdhesiveStress(pair, r);
  const double s = r * std::sqrt(PressedOverlap(pair, stress) / 2);             // √(R* δ)
  const double damping = pair.rolling_damping * r / 2 * std::sqrt(s * i_star);  // R3
  return damping * dt / (0.2 * mass * r * r);
}

double LongestRollingStep(const PairConstants& pair, const BedGrains& grains) {
  const double of_a_second = DampedShare(pair, grains, 1);
  return of_a_second > 0 ? kMostDampedShare / of_a_second : std::numeric_limits<double>::infinity();
}

}  // namespace talus::engine
