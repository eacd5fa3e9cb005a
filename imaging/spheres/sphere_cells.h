// Which spheres are near one another.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/sphere.h"

namespace talus::imaging {

// Spheres sorted into cubes as wide as the largest diameter, so that whatever touches a sphere is
// in its cube or in one of the 26 round it.
class SphereCells {
 public:
  SphereCells(std::span<const base::Sphere> spheres, double width) : width_(width) {
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

}  // namespace talus::imaging
