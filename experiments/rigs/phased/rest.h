// When a powder is at rest (docs/physics.md, 7).
#pragma once

#include <span>
#include <vector>

#include "engine/simulation.h"

namespace talus::rigs {

// Mean kinetic energy of a grain over its m g d: Σ E / Σ m g d, weighted by mass.
class EnergyRatio {
 public:
  explicit EnergyRatio(double gravity) : gravity_(gravity) {}

  // `spin` is ω where its energy counts, zero where it does not [rad/s].
  void Add(const engine::Particle& grain, const engine::Vec3& velocity, const engine::Vec3& spin);
  double Value() const;

  // Without the fastest grains that make up `share` of the weight, rounded up to a whole grain; one
  // that makes up more than a tenth of it is not left out.
  double ValueWithoutFastest(double share) const;

 private:
  struct Grain {
    double energy;  // in units of m g d
    double weight;  // m g d, without the density and 4π/3
  };
  double gravity_;  // [m/s²]
  std::vector<Grain> grains_;
};

// Mean kinetic energy of a grain over its m g d, without the fastest grains that make up
// `moving_share` of the weight.
struct RestQuestion {
  double gravity = 9.81;    // [m/s²]
  double moving_share = 0;  // [-], in [0, 1)
  bool spins_count = true;  // without friction nothing resists any spin
};
double RestingEnergy(std::span<const engine::Particle> particles,
                     std::span<const engine::ContactInfo> contacts, const RestQuestion& question);

}  // namespace talus::rigs
