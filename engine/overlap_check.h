// Spheres that start where none can be.
#pragma once

#include "base/problems.h"
#include "engine/scene.h"

namespace talus::engine {

inline constexpr double kMaxOverlap = 0.25;  // of two spheres at the start, over the smaller radius

// Reports spheres of a scene, valid in all else, that overlap so much that they would explode, or
// that stand in or behind a wall.
void ValidateOverlaps(const Scene& scene, base::Problems& problems);

}  // namespace talus::engine
