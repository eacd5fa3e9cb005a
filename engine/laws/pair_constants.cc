#include "engine/laws/pair_constants.h"

#include <cmath>
#include <numbers>

namespace talus::engine {

double DampingRatio(double restitution) {
  const double log_e = std::log(restitution);
  return -log_e / std::sqrt(log_e * log_e + std::numbers::pi * std::numbers::pi);
}

double HarmonicMean(double a, double b) { return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0.0; }

namespace {

double EffectiveModulus(const Material& a, const Material& b) {  // P3
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus);
}

double EffectiveShearModulus(const Material& a, const Material& b) {  // P4
  const auto compliance = [](const Material& m) {
    return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.youngs_modulus;
  };
  return 1 / (compliance(a) + compliance(b));
}

double PairSurfaceEnergy(const Material& a, const Material& b) {  // P6
  if (!(a.surface_energy > 0 && b.surface_energy > 0)) return 0;
  const double difference = std::sqrt(a.surface_energy) - std::sqrt(b.surface_energy);
  return a.surface_energy + b.surface_energy - difference * difference;
}

// The range of (A2) grows as γ^(-1/2): below this, pull-off holds no grain of a micrometre, and
// each would be listed with all that are within some twenty micrometres.
constexpr double kLeastOfDmt = 1e-10;  // [J/m²]

void AddAdhesion(const Material& a, const Material& b, const ContactModels& models,
                 PairConstants& pair) {
  pair.surface_energy = PairSurfaceEnergy(a, b);
  pair.pull_off = 2 * std::numbers::pi * pair.surface_energy;
  pair.jkr_cube_root = std::cbrt(pair.pull_off / pair.y_star);
  if (models.adhesion == Adhesion::kJkr) {
    const bool from_pull_off = models.jkr_rolling_limit == JkrRollingLimit::kFromPullOff;
    pair.rolling_pull_off = from_pull_off ? 1.5 * pair.pull_off : 0;
    pair.keeps_spring = models.jkr_sliding_spring == JkrSlidingSpring::kKept;
  }
  if (models.adhesion != Adhesion::kDmt) return;
  if (pair.surface_energy < kLeastOfDmt) {
    pair.pull_off = 0;
    return;
  }
  pair.hamaker = (a.hamaker_constant + b.hamaker_constant) / 2 / 6;  // P7
  pair.plateau_gap = std::sqrt(pair.hamaker / pair.pull_off);        // A2, R* cancels
  pair.adhesion_gap = pair.plateau_gap / std::sqrt(models.adhesion_cutoff);
}

}  // namespace

PairConstants MakePairConstants(const Material& a, const Material& b, const ContactModels& models) {
  PairConstants pair;
  pair.y_star = EffectiveModulus(a, b);
  pair.normal_stiffness = 4.0 / 3.0 * pair.y_star;
  pair.shear_stiffness = 8 * EffectiveShearModulus(a, b);
  pair.shear_compliance = 1 / pair.shear_stiffness;
  const double beta = DampingRatio(HarmonicMean(a.restitution, b.restitution));
  const double damping = 2 * std::sqrt(5.0 / 6.0) * beta;
  pair.normal_damping = damping * std::sqrt(1.5 * pair.normal_stiffness);
  pair.tangential_damping = damping * std::sqrt(pair.shear_stiffness);
  pair.sliding_friction = HarmonicMean(a.sliding_friction, b.sliding_friction);
  pair.rolling_friction = HarmonicMean(a.rolling_friction, b.rolling_friction);
  pair.rolling_stiffness =
      2.25 * pair.normal_stiffness * pair.rolling_friction * pair.rolling_friction;
  pair.rolling_damping =
      2 * HarmonicMean(a.rolling_damping, b.rolling_damping) * std::sqrt(pair.rolling_stiffness);
  pair.mobilised_damping = models.full_mobilisation_damping;
  if (models.adhesion != Adhesion::kNone) AddAdhesion(a, b, models, pair);
  return pair;
}

}  // namespace talus::engine
