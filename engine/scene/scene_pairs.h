// The pairs of a scene file: which materials they mean, and whether these can touch.
#pragma once

#include <vector>

#include "base/problems.h"
#include "engine/laws/material_pair.h"
#include "engine/scene/scene_spec.h"

namespace talus::engine {

// Names that are none, pairs given twice, materials that never touch.
void ValidatePairs(const SceneSpec& spec, base::Problems& problems);

// The pairs of a valid spec.
std::vector<MaterialPair> BuildPairs(const SceneSpec& spec);

}  // namespace talus::engine
