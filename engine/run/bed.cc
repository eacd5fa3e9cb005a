#include "engine/run/bed.h"

#include <vector>

#include "base/sphere.h"
#include "engine/run/resisted_spins.h"

namespace talus::engine {

Bed MeasureBed(const Simulation& simulation, const Vessel& vessel) {
  double volume = 0, moment = 0;
  std::int64_t grains = 0;
  const std::vector<Particle> particles = simulation.Particles();
  std::vector<bool> counts(particles.size(), false);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle& p = particles[i];
    if (p.id >= vessel.end_id || p.position.z < vessel.floor) continue;  // has fallen out
    counts[i] = true;
    ++grains;
    const double v = base::SphereVolume(p.radius);
    volume += v;
    moment += v * (p.position.z - vessel.floor);
  }
  if (volume == 0) return {};
  std::int64_t touching = 0;
  const PlaceOfId place_of(particles);
  for (const ContactInfo& contact : simulation.Contacts()) {
    if (contact.second < 0) continue;  // with a wall
    touching += counts[place_of(contact.first)] && counts[place_of(contact.second)];
  }
  Bed bed;
  bed.height = 2 * moment / volume;
  bed.solid_fraction = volume / (vessel.area * bed.height);
  bed.coordination = 2 * static_cast<double>(touching) / static_cast<double>(grains);
  return bed;
}

}  // namespace talus::engine
