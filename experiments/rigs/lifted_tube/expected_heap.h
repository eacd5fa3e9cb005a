// What a lifted tube will leave, for what a test costs: a cone of middling slope on the plate.
#pragma once

#include <cmath>
#include <numbers>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

struct ExpectedHeap {
  double height = 0;     // [m]
  double share = 1;      // of the powder that stays on the plate [-]
  double rest_time = 0;  // that it takes to come to rest [s]
};

inline ExpectedHeap ExpectHeap(const Case& c) {
  constexpr double kSlope = 0.65;
  constexpr double kSlopeOfAll = 0.4;  // with all of the powder, which runs out on a wide plate
  constexpr double kSolid = 0.58;
  const double bulk = c.powder.mass / c.powder.material.density / kSolid;  // [m³]
  const double radius = c.rig.lifted_tube.plate_diameter / 2;
  const double full = std::numbers::pi / 3 * radius * radius * radius * kSlope;  // [m³]
  ExpectedHeap heap{.rest_time = 8 * std::sqrt(c.rig.lifted_tube.tube_inner_diameter / c.gravity)};
  if (bulk >= full) {
    heap.height = kSlope * radius;
    heap.share = full / bulk;
  } else {
    heap.height = std::cbrt(3 * bulk * kSlopeOfAll * kSlopeOfAll / std::numbers::pi);
  }
  return heap;
}

}  // namespace talus::rigs
