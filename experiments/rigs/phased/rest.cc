#include "experiments/rigs/phased/rest.h"

#include <algorithm>

#include "engine/run/resisted_spins.h"

namespace talus::rigs {

using engine::Particle;
using engine::Vec3;

void EnergyRatio::Add(const Particle& grain, const Vec3& velocity, const Vec3& spin) {
  const double r = grain.radius;
  const double per_mass = Dot(velocity, velocity) / 2 + 0.2 * r * r * Dot(spin, spin);
  const double per_energy = gravity_ * 2 * r;
  grains_.push_back({.energy = per_mass / per_energy, .weight = r * r * r * per_energy});
}

double EnergyRatio::Value() const {
  double energy = 0, weight = 0;
  for (const Grain& g : grains_) {
    energy += g.weight * g.energy;
    weight += g.weight;
  }
  return weight > 0 ? energy / weight : 0;
}

double EnergyRatio::ValueWithoutFastest(double share) const {
  EnergyRatio rest = *this;
  std::vector<Grain>& slowest = rest.grains_;
  std::sort(slowest.begin(), slowest.end(),
            [](const Grain& a, const Grain& b) { return a.energy < b.energy; });
  double weight = 0;
  for (const Grain& g : slowest) weight += g.weight;
  constexpr double kFew = 0.1;  // of the weight: a grain with more of it is never left out
  for (double to_leave = share * weight; to_leave > 0 && !slowest.empty(); slowest.pop_back()) {
    if (slowest.back().weight > kFew * weight) break;
    to_leave -= slowest.back().weight;
  }
  return rest.Value();
}

double RestingEnergy(std::span<const Particle> particles,
                     std::span<const engine::ContactInfo> contacts, const RestQuestion& question) {
  const std::vector<Vec3> spins = engine::ResistedSpins(particles, contacts);
  EnergyRatio energy(question.gravity);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    energy.Add(particles[i], particles[i].velocity, question.spins_count ? spins[i] : Vec3());
  }
  return energy.ValueWithoutFastest(question.moving_share);
}

}  // namespace talus::rigs
