// The pouring of a test's powder into its tube or box.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/pour.h"
#include "experiments/rigs/lifted_tube/heap_case.h"
#include "experiments/rigs/vessel.h"

namespace talus::rigs {

// Radii of the scaled grains, in the order in which they come [m].
std::vector<double> DrawRadii(const HeapCase& heap_case);

// Of the mouth [m].
double MouthDiameter(const HeapCase& heap_case, const Vessel& vessel);

engine::Pour MakePour(const HeapCase& heap_case, const Vessel& vessel);

// Height of the mouth above the powder, which it follows as the vessel fills to a solid fraction of
// a half [m].
double DropHeight(const HeapCase& heap_case, const Vessel& vessel);

// What walls that have no height of their own must hold [m].
double PouredHeight(const HeapCase& heap_case, const Vessel& vessel);

// Overlap over radius of the heaviest blow that a grain gets when it comes down alone: on the
// plate (the floor), on the tube (the walls) or on a grain at rest. From the energy of a Hertz
// contact,
//
//   (8/15) E* √R* δ^(5/2) = m* v²/2,   v² = v₀² + 2 g H
double ImpactShare(const HeapCase& heap_case, const Vessel& vessel);

// Of the smallest grain where it lies on the plate and the largest comes down on it.
double SqueezeShare(const HeapCase& heap_case, const Vessel& vessel);

// What holds. Of wet sand, squeezed by 0.83, none of 300 pours lost a grain through the plate; at
// 0.89 one of 250 did (docs/validation.md, Filling).
inline constexpr double kMaxImpactShare = 0.3;
inline constexpr double kMaxSqueezeShare = 0.85;

}  // namespace talus::rigs
