#include "engine/run/resisted_spins.h"

namespace talus::engine {

PlaceOfId::PlaceOfId(std::span<const Particle> particles) {
  if (particles.empty()) return;
  first_id_ = particles.front().id;
  places_.resize(particles.back().id - first_id_ + 1);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    places_[particles[i].id - first_id_] = static_cast<std::uint32_t>(i);
  }
}

std::vector<Vec3> ResistedSpins(std::span<const Particle> particles,
                                std::span<const ContactInfo> contacts) {
  const PlaceOfId place_of(particles);
  std::vector<int> num_contacts(particles.size(), 0);
  std::vector<Vec3> normal(particles.size());
  for (const ContactInfo& contact : contacts) {
    const std::size_t i = place_of(contact.first);
    ++num_contacts[i];
    normal[i] = contact.normal;
    if (contact.second < 0) continue;
    const std::size_t j = place_of(contact.second);
    ++num_contacts[j];
    normal[j] = contact.normal;
  }
  std::vector<Vec3> spins;
  spins.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3& spin = particles[i].angular_velocity;
    spins.push_back(num_contacts[i] == 1 ? spin - Dot(spin, normal[i]) * normal[i] : spin);
  }
  return spins;
}

}  // namespace talus::engine
