// The angles of repose of a round heap, as methods read them off its mean silhouette
// (docs/imaging.md): 1, 2 and 3, and the triangle of equal area; and how far the heap is from that
// triangle.
#pragma once

#include <span>
#include <vector>

#include "engine/scene.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::rigs {

struct RoundPlate {
  double diameter = 0;        // [m]
  double grain_diameter = 0;  // mean, of the scaled grains [m]
};

std::vector<Reading> ReposeReadings(std::span<const engine::Particle> heap,
                                    const RoundPlate& plate);

}  // namespace talus::rigs
