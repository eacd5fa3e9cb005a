// Walls as polygons, for programs that draw.
#pragma once

#include <string>
#include <vector>

#include "base/vec3.h"
#include "engine/bodies/wall.h"

namespace talus::analysis {

struct WallMesh {
  std::vector<base::Vec3> points;          // [m]
  std::vector<std::vector<int>> polygons;  // indices into `points`
};

// Round shapes have 64 corners; a plane, which has no end, has no polygon.
WallMesh MeshOf(const engine::WallShape& shape);

// PolyData of VTK's XML format, as text.
std::string VtpOf(const WallMesh& mesh);

}  // namespace talus::analysis
