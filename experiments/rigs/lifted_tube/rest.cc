#include "experiments/rigs/lifted_tube/rest.h"

#include <algorithm>
#include <cmath>

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
  double to_leave = 0;
  for (const Grain& g : slowest) to_leave += share * g.weight;
  for (; to_leave > 0 && !slowest.empty(); slowest.pop_back()) to_leave -= slowest.back().weight;
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

namespace {

// Faster than after a free fall over its own diameter: no contact holds such a grain.
bool Falls(const Particle& p, double gravity) {
  return p.velocity.z < 0 && p.velocity.z * p.velocity.z > 4 * gravity * p.radius;
}

// What the plate, the tube and all grains that hang on them take up.
struct Extent {
  double radius = 0;  // about the axis [m]
  double bottom = 0;  // the lowest point, the plate's top at most [m]

  void Add(const Particle& p) {
    radius = std::max(radius, std::hypot(p.position.x, p.position.y) + p.radius);
    bottom = std::min(bottom, p.position.z - p.radius);
  }
  bool Above(const Particle& p, double gravity) const {
    const double rise = p.velocity.z > 0 ? p.velocity.z * p.velocity.z / (2 * gravity) : 0;
    return p.position.z + p.radius + rise < (Falls(p, gravity) ? 0 : bottom);
  }
  bool Inside(const Particle& p) const {
    const double outwards = p.position.x * p.velocity.x + p.position.y * p.velocity.y;
    return std::hypot(p.position.x, p.position.y) - p.radius > radius && outwards >= 0;
  }
};

}  // namespace

std::vector<std::int64_t> CanOnlyFall(std::span<const Particle> particles,
                                      const Connectivity& connected, const Device& device,
                                      double gravity) {
  Extent extent{.radius = std::max(device.plate_diameter, device.tube_inner_diameter) / 2};
  std::vector<const Particle*> loose;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle& p = particles[i];
    const bool hangs = (connected.on_plate[i] || connected.on_tube[i]) && !Falls(p, gravity);
    if (!hangs) {
      loose.push_back(&p);
    } else {
      extent.Add(p);
    }
  }
  std::vector<std::int64_t> ids;
  for (const Particle* p : loose) {
    if (extent.Above(*p, gravity) || extent.Inside(*p)) ids.push_back(p->id);
  }
  return ids;
}

}  // namespace talus::rigs
