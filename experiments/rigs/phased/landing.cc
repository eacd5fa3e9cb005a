#include "experiments/rigs/phased/landing.h"

#include <algorithm>
#include <cmath>

#include "experiments/rigs/phased/contact_sets.h"

namespace talus::rigs {
namespace {

using engine::Particle;

// `fall` down from where it is, within its diameter.
bool Lands(const Particle& p, double fall) { return fall >= 0 && fall <= 2 * p.radius; }

bool LandsOn(const Particle& p, const Particle& below) {
  const double reach = p.radius + below.radius;
  const double x = p.position.x - below.position.x, y = p.position.y - below.position.y;
  const double square = reach * reach - x * x - y * y;
  return square > 0 && Lands(p, p.position.z - below.position.z - std::sqrt(square));
}

}  // namespace

void AddLanding(std::span<const Particle> particles, double plate_radius,
                std::vector<bool>& on_heap) {
  std::vector<std::size_t> flying;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!on_heap[i]) flying.push_back(i);
  }
  // The lowest first, so that one may land on another.
  std::stable_sort(flying.begin(), flying.end(), [&](std::size_t a, std::size_t b) {
    return particles[a].position.z < particles[b].position.z;
  });
  for (const std::size_t i : flying) {
    const Particle& p = particles[i];
    bool lands =
        std::hypot(p.position.x, p.position.y) <= plate_radius && Lands(p, p.position.z - p.radius);
    for (std::size_t j = 0; j < particles.size() && !lands; ++j) {
      lands = on_heap[j] && LandsOn(p, particles[j]);
    }
    on_heap[i] = lands;
  }
}

std::vector<Particle> HeapOn(const engine::Simulation& simulation, int plate, double plate_radius) {
  const std::vector<Particle> particles = simulation.Particles();
  const std::vector<engine::ContactInfo> contacts = simulation.Contacts();
  std::vector<bool> on_heap = ContactSets(particles, contacts).Reaching(plate);
  AddLanding(particles, plate_radius, on_heap);
  std::vector<Particle> heap;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (on_heap[i]) heap.push_back(particles[i]);
  }
  return heap;
}

}  // namespace talus::rigs
