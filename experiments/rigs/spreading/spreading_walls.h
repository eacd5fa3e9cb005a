// The walls of a spreading rig. x runs along the path, its origin where the plate begins; z = 0 is
// the top of the plate, or of the bed of powder in its place.
//
// Blade and comb: the heap stands on a platform as high as their edge. A roller would press grains
// into the platform there, so its heap stands on the ground, and it passes one gap above.
#pragma once

#include <vector>

#include "engine/bodies/wall.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/filling/vessel.h"

namespace talus::rigs {

// Height of the ground that the heap stands on [m].
double PlatformHeight(const Case& rig_case);

// How far the spreader's leading line, its lowest one, begins behind the heap [m].
double BehindHeap(const Case& rig_case);

// The first of the walls, which move together.
int NumSpreaderWalls(const Case& rig_case);

// That the heap is filled into, with the bed of powder beside it.
Vessel SpreadingVessel(const Case& rig_case);

// Around powder that is filled `height` [m] high.
std::vector<engine::Wall> SpreadingWalls(const Case& rig_case, double height);

}  // namespace talus::rigs
