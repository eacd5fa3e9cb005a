// Grains as a silhouette needs them.
#pragma once

#include <span>
#include <vector>

#include "base/sphere.h"
#include "engine/scene.h"

namespace talus::rigs {

inline std::vector<base::Sphere> SpheresOf(std::span<const engine::Particle> grains) {
  std::vector<base::Sphere> spheres;
  spheres.reserve(grains.size());
  for (const engine::Particle& p : grains) spheres.push_back({p.position, p.radius});
  return spheres;
}

}  // namespace talus::rigs
