// Where a sphere is, what the engine hands to the images; and its volume.
#pragma once

#include <numbers>

#include "base/vec3.h"

namespace talus::base {

struct Sphere {
  Vec3 position;      // centre [m]
  double radius = 0;  // [m], > 0
};

// [m³]
inline double SphereVolume(double radius) {
  return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

}  // namespace talus::base
