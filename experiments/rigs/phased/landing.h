// Grains that touch nothing when a heap test ends.
//
// One that hops or has just been let go belongs to the heap if it is about to land on it: falling
// straight down it would meet the plate or a grain of the heap within its own diameter. The others
// are in flight.
#pragma once

#include <span>
#include <vector>

#include "engine/scene.h"
#include "engine/simulation.h"

namespace talus::rigs {

// Marks in `on_heap` (one for each particle) those that are about to land. The plate's top is z =
// 0.
void AddLanding(std::span<const engine::Particle> particles, double plate_radius,
                std::vector<bool>& on_heap);

// The heap on a plate of this radius [m], the wall of this index: the grains that a chain of
// contacts connects with it, or that are about to land, by id.
std::vector<engine::Particle> HeapOn(const engine::Simulation& simulation, int plate,
                                     double plate_radius);

}  // namespace talus::rigs
