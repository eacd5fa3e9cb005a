#include "imaging/spheres/coincident.h"

#include <algorithm>

#include "imaging/spheres/sphere_cells.h"

namespace talus::imaging {

std::size_t NumCoincident(std::span<const base::Sphere> spheres) {
  double largest = 0;
  for (const base::Sphere& sphere : spheres) largest = std::max(largest, sphere.radius);
  if (!(largest > 0)) return 0;
  const SphereCells cells(spheres, 2 * largest);
  std::size_t count = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    bool coincides = false;
    cells.ForEachNear(spheres[i].position, [&](std::size_t other) {
      const double nearest = std::min(spheres[i].radius, spheres[other].radius);
      coincides |= other < i && base::Norm(spheres[i].position - spheres[other].position) < nearest;
    });
    count += coincides ? 1 : 0;
  }
  return count;
}

}  // namespace talus::imaging
