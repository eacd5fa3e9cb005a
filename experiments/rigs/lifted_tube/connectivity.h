// Which grains hang together with the plate, and which with the tube only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/simulation.h"

namespace talus::rigs {

struct Connectivity {
  std::vector<bool> on_plate;      // of each particle: a chain of contacts leads to the plate
  std::vector<bool> on_tube;       // not on_plate, and a chain leads to the tube
  bool tube_touches_heap = false;  // a grain that is on_plate touches the tube
};

// Where the particle with an id is in `particles`, which are by id.
class PlaceOfId {
 public:
  explicit PlaceOfId(std::span<const engine::Particle> particles);
  std::size_t operator()(std::int64_t id) const { return places_[id - first_id_]; }

 private:
  std::int64_t first_id_ = 0;
  std::vector<std::uint32_t> places_;
};

// `particles` by id, as Simulation::Particles gives them.
Connectivity Connect(std::span<const engine::Particle> particles,
                     std::span<const engine::ContactInfo> contacts);

}  // namespace talus::rigs
