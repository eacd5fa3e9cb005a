#include "experiments/rigs/lifted_tube/connectivity.h"

#include "experiments/rigs/phased/contact_sets.h"

namespace talus::rigs {

Connectivity Connect(std::span<const engine::Particle> particles,
                     std::span<const engine::ContactInfo> contacts) {
  const ContactSets sets(particles, contacts);
  Connectivity result{.on_plate = sets.Reaching(kPlate), .on_tube = sets.Hanging({kTube}, kPlate)};
  const std::vector<bool> touches_tube = sets.Touching(kTube);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    result.tube_touches_heap |= result.on_plate[i] && touches_tube[i];
  }
  return result;
}

}  // namespace talus::rigs
