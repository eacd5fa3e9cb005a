#include "engine/neighbor/sphere_index.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/threads/team.h"

namespace talus::engine {

SphereIndex::SphereIndex(std::span<const Particle> spheres) {
  std::vector<double> rows;
  std::map<int, std::vector<std::int32_t>> spheres_of_size;  // by the exponent of 2 of their radii
  for (const Particle& p : spheres) {
    spheres_of_size[std::ilogb(p.radius)].push_back(static_cast<std::int32_t>(rows.size() / 3));
    rows.insert(rows.end(), {p.position.x, p.position.y, p.position.z});
  }
  Team team(1);
  for (const auto& [size, numbers] : spheres_of_size) {
    Layer& layer = layers_.emplace_back();
    for (const std::int32_t k : numbers) {
      layer.largest = std::max(layer.largest, spheres[static_cast<std::size_t>(k)].radius);
    }
    layer.grid.Build(rows.data(), 3, numbers, 2 * layer.largest, team);
  }
}

}  // namespace talus::engine
