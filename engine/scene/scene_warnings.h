// Warnings: parts of a valid scene that are likely not what its author means. A run says it at its
// start.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/laws/material_pair.h"
#include "engine/scene/scene_spec.h"

namespace talus::engine {

// Adhesion without a surface energy, or a surface energy without adhesion, of materials of which
// those at the indices `of_spheres` touch each other and all others: one without a surface energy
// adheres to none (P6), unless the pair states its own.
std::vector<std::string> AdhesionWarnings(const ContactModels& models,
                                          const std::vector<Material>& materials,
                                          std::span<const MaterialPair> pairs,
                                          std::span<const int> of_spheres);

// These, grains too few for their distribution, a time step above 0.20 of the Rayleigh time (M4),
// and states that come after the end.
std::vector<std::string> SceneWarnings(const SceneSpec& spec, const Scene& scene);

}  // namespace talus::engine
