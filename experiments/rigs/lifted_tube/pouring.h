// The pouring of a heap test's powder into its tube.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/pour.h"
#include "experiments/rigs/lifted_tube/heap_case.h"

namespace talus::rigs {

// Radii of the scaled grains, in the order in which they come [m].
std::vector<double> DrawRadii(const HeapCase& heap_case);

engine::Pour MakePour(const HeapCase& heap_case);

// Height of the mouth above the powder, which it follows as the tube fills to a solid fraction of a
// half [m].
double DropHeight(const HeapCase& heap_case);

// Of a tube that has no length of its own [m].
double PouredTubeLength(const HeapCase& heap_case);

// Overlap over radius of the heaviest blow that a grain gets when it comes down alone: on the
// plate, on the tube or on a grain at rest. From the energy of a Hertz contact,
//
//   (8/15) E* √R* δ^(5/2) = m* v²/2,   v² = v₀² + 2 g H
double ImpactShare(const HeapCase& heap_case);

// Beyond this share, grains were pressed through the plate: a blow on a small grain that lies on it
// is that of a larger one.
inline constexpr double kMaxImpactShare = 0.3;

}  // namespace talus::rigs
