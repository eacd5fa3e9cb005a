// The materials of a case's scene.
#pragma once

#include <vector>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Indices into the scene's materials.
inline constexpr int kPowder = 0;
inline constexpr int kWalls = 1;  // WallMaterials::walls
inline constexpr int kFloor = 2;  // WallMaterials::floor

// f^p: what every surface energy of a case is multiplied by, the walls' own and those that pairs
// state included, so that no adhesion loses ground to another (docs/physics.md, C1).
double SurfaceEnergyFactor(const Case& rig_case);

// With the coarse graining applied.
std::vector<engine::Material> MaterialsOf(const Case& rig_case);
engine::Material UsedMaterial(const Case& rig_case);

}  // namespace talus::rigs
