#include <algorithm>
#include <cmath>

#include "imaging/spheres/projection.h"
#include "imaging/spheres/sphere_cells.h"

namespace talus::imaging {
namespace {

// Distance from the plate's top, a disc in z = 0, of a point above it.
double DistanceFromPlate(const base::Vec3& position, double plate_radius) {
  const double beyond = std::max(std::hypot(position.x, position.y) - plate_radius, 0.0);
  return std::hypot(beyond, position.z);
}

}  // namespace

std::vector<base::Sphere> GrainsOnPlate(std::span<const base::Sphere> spheres,
                                        double plate_diameter, double tolerance) {
  double largest = 0;
  for (const base::Sphere& sphere : spheres) largest = std::max(largest, sphere.radius);
  if (!(largest > 0)) return {};
  const SphereCells cells(spheres, largest * (2 + tolerance));
  std::vector<bool> held(spheres.size());
  std::vector<std::size_t> front;  // held, neighbours not looked at yet
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const base::Vec3& position = spheres[i].position;
    held[i] = position.z > 0 && DistanceFromPlate(position, plate_diameter / 2) <=
                                    spheres[i].radius * (1 + tolerance);
    if (held[i]) front.push_back(i);
  }
  while (!front.empty()) {
    const base::Sphere& grain = spheres[front.back()];
    front.pop_back();
    cells.ForEachNear(grain.position, [&](std::size_t i) {
      const double reach =
          grain.radius + spheres[i].radius + tolerance * std::min(grain.radius, spheres[i].radius);
      if (held[i] || base::Norm(spheres[i].position - grain.position) > reach) return;
      held[i] = true;
      front.push_back(i);
    });
  }
  std::vector<base::Sphere> heap;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (held[i]) heap.push_back(spheres[i]);
  }
  return heap;
}

}  // namespace talus::imaging
