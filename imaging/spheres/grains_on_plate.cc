#include <algorithm>
#include <cmath>
#include <cstdint>

#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace {

// Spheres sorted into cubes as wide as the largest diameter, so that whatever touches a sphere is
// in its cube or in one of the 26 round it.
class Cells {
 public:
  Cells(std::span<const base::Sphere> spheres, double width) : width_(width) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      entries_.push_back({.key = KeyOf(CellOf(spheres[i].position), {}), .sphere = i});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  template <class Body>
  void ForEachNear(const base::Vec3& position, Body&& body) const {
    const Cell cell = CellOf(position);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const std::uint64_t key = KeyOf(cell, {x, y, z});
          auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{.key = key});
          for (; entry != entries_.end() && entry->key == key; ++entry) body(entry->sphere);
        }
      }
    }
  }

 private:
  struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
  };
  struct Entry {
    std::uint64_t key = 0;
    std::size_t sphere = 0;
    auto operator<=>(const Entry&) const = default;
  };

  Cell CellOf(const base::Vec3& p) const { return {Index(p.x), Index(p.y), Index(p.z)}; }
  // Far-away grains (flung off the plate) share the last cell: more to test, nothing missed.
  std::int64_t Index(double length) const {
    return static_cast<std::int64_t>(std::clamp(std::floor(length / width_), -1e6, 1e6));
  }
  // 21 bits each, exact for the clamped indices.
  static std::uint64_t KeyOf(const Cell& cell, const Cell& step) {
    const auto part = [](std::int64_t index) {
      return static_cast<std::uint64_t>(index + (1 << 20)) & ((1u << 21) - 1);
    };
    return part(cell.x + step.x) << 42 | part(cell.y + step.y) << 21 | part(cell.z + step.z);
  }

  double width_;
  std::vector<Entry> entries_;
};

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
  const Cells cells(spheres, largest * (2 + tolerance));
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
