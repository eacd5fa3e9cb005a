// Whether spheres fit on the plate that they are said to stand on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "base/sphere.h"
#include "base/text/counted.h"
#include "base/text/number_text.h"

namespace talus::trials {

// What is wrong where the largest sphere is as wide as a plate of `plate_diameter` [m]: a file in
// millimetres that says nothing of it is read in metres.
inline std::optional<std::string> WiderThanPlate(std::span<const base::Sphere> spheres,
                                                 double plate_diameter) {
  double largest = 0;  // diameter [m]
  for (const base::Sphere& s : spheres) largest = std::max(largest, 2 * s.radius);
  if (largest < plate_diameter) return std::nullopt;
  return "a sphere of " + base::ShortNumber(largest) + " m, which is wider than the plate of " +
         base::ShortNumber(plate_diameter) + " m";
}

// What is wrong where spheres stand in the plate, deeper than half their radius: its top is not at
// z = 0, or particles that make up walls are among them. `heap`: of a plate of `plate_diameter`
// [m].
inline std::optional<std::string> InsidePlate(std::span<const base::Sphere> heap,
                                              double plate_diameter) {
  std::size_t count = 0;
  double lowest = 0;  // z [m]
  for (const base::Sphere& s : heap) {
    if (std::hypot(s.position.x, s.position.y) > plate_diameter / 2) continue;
    if (s.position.z > s.radius / 2) continue;
    lowest = count == 0 ? s.position.z : std::min(lowest, s.position.z);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return base::Counted(static_cast<long long>(count), "sphere") +
         " inside the plate, the lowest centre at z = " + base::ShortNumber(lowest) + " m";
}

}  // namespace talus::trials
