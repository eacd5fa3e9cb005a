#include "engine/laws/longest_step.h"

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

double MassOf(const BedGrains& grains) {
  return grains.density * base::SphereVolume(grains.radius);
}

double SquaredRadiusTimesMass(const BedGrains& grains) {  // m R² [kg m²]
  return MassOf(grains) * grains.radius * grains.radius;
}

// a and b of sliding in a second.
struct Sliding {
  double share = 0;
  double phase = 0;
};

Sliding SlidingOf(const PairConstants& pair, const BedGrains& grains) {
  if (pair.sliding_friction == 0) return {};  // Coulomb's limit leaves neither (T2)
  const double mass = MassOf(grains);
  const double s = ContactRadius(pair, grains);
  return {.share = 5 * pair.tangential_damping * std::sqrt(s * mass / 2) / mass,  // N4
          .phase = std::sqrt(5 * pair.shear_stiffness * s / mass)};               // N1
}

// Where 2 a Δt + (b Δt)² is kMostSlidingLoad.
double LongestSlidingStep(const Sliding& of_a_second) {
  const auto [a, b] = of_a_second;
  const double root = std::sqrt(a * a + kMostSlidingLoad * b * b);
  return a + root > 0 ? kMostSlidingLoad / (a + root) : std::numeric_limits<double>::infinity();
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

double SlidingLoad(const PairConstants& pair, const BedGrains& grains, double dt) {
  const auto [a, b] = SlidingOf(pair, grains);
  return 2 * a * dt + b * b * dt * dt;
}

StepLimit LongestStep(const PairConstants& pair, const BedGrains& grains, Rolling rolling) {
  StepLimit limit{.step = LongestSlidingStep(SlidingOf(pair, grains)),
                  .bound = StepBound::kSlidingDashpot};
  const auto bound = [&](double of_a_second, double most, StepBound by) {
    if (of_a_second * limit.step > most) limit = {.step = most / of_a_second, .bound = by};
  };
  if (rolling != Rolling::kEpsd) return limit;
  bound(DampedShare(pair, grains, 1), kMostDampedShare, StepBound::kRollingDashpot);
  bound(SpringPhase(pair, grains, 1), kMostSpringPhase, StepBound::kRollingSpring);
  return limit;
}

}  // namespace talus::engine
