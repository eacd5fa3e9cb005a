// The grains that have left a heap for good (docs/physics.md, 7).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "experiments/rigs/lifted_tube/connectivity.h"
#include "experiments/rigs/options/lifted_tube_options.h"

namespace talus::rigs {

// Ids, ascending, of the grains that can only fall. They hang together with neither plate nor tube,
// or fall faster than after a free fall over their own diameter, and are
// - whole below the plate's top (and, if slow, below all that hangs on it), too slow to come back
// up;
// - or beyond plate, tube and all that hangs on them, and moving outwards.
std::vector<std::int64_t> CanOnlyFall(std::span<const engine::Particle> particles,
                                      const Connectivity& connected,
                                      const LiftedTubeOptions& device, double gravity);

}  // namespace talus::rigs
