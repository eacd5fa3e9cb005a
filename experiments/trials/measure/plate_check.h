// Whether spheres fit on the plate that they are said to stand on.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "base/sphere.h"
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

}  // namespace talus::trials
