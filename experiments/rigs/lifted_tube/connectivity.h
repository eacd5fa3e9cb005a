// Which grains hang together with the plate, and which with the tube only.
#pragma once

#include <span>
#include <vector>

#include "engine/simulation.h"

namespace talus::rigs {

// The walls of the lifted tube's scene, by their indices.
inline constexpr int kTube = 0;
inline constexpr int kPlate = 1;

struct Connectivity {
  std::vector<bool> on_plate;      // of each particle: a chain of contacts leads to the plate
  std::vector<bool> on_tube;       // not on_plate, and a chain leads to the tube
  bool tube_touches_heap = false;  // a grain that is on_plate touches the tube
};

// `particles` by id, as Simulation::Particles gives them.
Connectivity Connect(std::span<const engine::Particle> particles,
                     std::span<const engine::ContactInfo> contacts);

}  // namespace talus::rigs
