// Grains as a silhouette needs them, and how high they reach.
#pragma once

#include <algorithm>
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

// The height of the highest grain's top, at least 0 [m].
inline double TopOf(std::span<const engine::Particle> grains) {
  double top = 0;
  for (const engine::Particle& p : grains) top = std::max(top, p.position.z + p.radius);
  return top;
}

}  // namespace talus::rigs
