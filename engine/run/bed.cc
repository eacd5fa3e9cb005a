#include "engine/run/bed.h"

#include <numbers>

namespace talus::engine {

Bed MeasureBed(const Simulation& simulation, const Vessel& vessel) {
  double volume = 0, moment = 0;
  std::int64_t grains = 0;
  for (const Particle& p : simulation.Particles()) {
    if (p.id >= vessel.end_id || p.position.z < vessel.floor) continue;  // has fallen out
    ++grains;
    const double v = 4.0 / 3 * std::numbers::pi * p.radius * p.radius * p.radius;
    volume += v;
    moment += v * (p.position.z - vessel.floor);
  }
  if (volume == 0) return {};
  std::int64_t touching = 0;
  for (const ContactInfo& contact : simulation.Contacts()) {
    const bool inside = contact.first < vessel.end_id && contact.second < vessel.end_id;
    touching += inside && contact.second >= 0;
  }
  Bed bed;
  bed.height = 2 * moment / volume;
  bed.solid_fraction = volume / (vessel.area * bed.height);
  bed.coordination = 2 * static_cast<double>(touching) / static_cast<double>(grains);
  return bed;
}

}  // namespace talus::engine
