#include "engine/laws/rolling_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/sphere.h"
#include "engine/laws/pressed_bed.h"

namespace talus::engine {
namespace {

// √(R* δ) of a contact in the bed [m].
double ContactRadius(const PairConstants& pair, const BedGrains& grains) {
  const double stress = grains.stress + AdhesiveStress(pair, grains.radius);
  return grains.radius * std::sqrt(PressedOverlap(pair, stress) / 2);
}

double SquaredRadiusTimesMass(const BedGrains& grains) {  // m R² [kg m²]
  return grains.density * base::SphereVolume(grains.radius) * grains.radius * grains.radius;
}

}  // namespace

double DampedShare(const PairConstants& pair, const BedGrains& grains, double dt) {
  const double m_r2 = SquaredRadiusTimesMass(grains);
  const double damping = pair.rolling_damping * grains.radius / 2 *
                         std::sqrt(ContactRadius(pair, grains) * 0.7 * m_r2);  // R3
  return damping * dt / (0.2 * m_r2);
}

double SpringPhase(const PairConstants& pair, const BedGrains& grains, double dt) {
  const double r_star = grains.radius / 2;
  const double stiffness =
      pair.rolling_stiffness * ContactRadius(pair, grains) * r_star * r_star;  // R1
  return std::sqrt(stiffness / (0.2 * SquaredRadiusTimesMass(grains))) * dt;
}

RollingLimit LongestRollingStep(const PairConstants& pair, const BedGrains& grains) {
  const auto longest = [](double of_a_second, double most) {
    return of_a_second > 0 ? most / of_a_second : std::numeric_limits<double>::infinity();
  };
  const double of_dashpot = longest(DampedShare(pair, grains, 1), kMostDampedShare);
  const double of_spring = longest(SpringPhase(pair, grains, 1), kMostSpringPhase);
  return {.step = std::min(of_dashpot, of_spring), .is_spring = of_spring < of_dashpot};
}

}  // namespace talus::engine
