// Spheres that come where none can be: at the start, or later.
#pragma once

#include <span>

#include "base/problems.h"
#include "engine/scene.h"

namespace talus::engine {

struct SimulationState;  // engine/simulation_state.h

// The overlap of two spheres, one of which comes, over the smaller radius; and of one with a wall,
// over its own.
inline constexpr double kMaxOverlapAtStart = 0.25;

// Reports spheres of a scene, valid in all else, that overlap so much that they would explode, or
// that stand in or behind a wall.
void ValidateOverlaps(const Scene& scene, base::Problems& problems);

// The same of spheres that are to be added, also with those that are there. Those that are there
// may overlap each other as they do.
void ValidateAddedOverlaps(const SimulationState& state, std::span<const Particle> added,
                           base::Problems& problems);

}  // namespace talus::engine
