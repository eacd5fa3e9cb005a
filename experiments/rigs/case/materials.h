// The materials of a case's scene.
#pragma once

#include <vector>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Indices into the scene's materials.
inline constexpr int kPowder = 0;
inline constexpr int kWalls = 1;  // WallMaterials::walls
inline constexpr int kFloor = 2;  // WallMaterials::floor

std::vector<engine::Material> MaterialsOf(const Case& rig_case);

// The powder's material with the coarse graining applied (docs/physics.md, C1).
engine::Material UsedMaterial(const Case& rig_case);

}  // namespace talus::rigs
