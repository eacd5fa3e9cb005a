// Where a sphere is: what the engine hands to the images.
#pragma once

#include "base/vec3.h"

namespace talus::base {

struct Sphere {
  Vec3 position;      // centre [m]
  double radius = 0;  // [m], > 0
};

}  // namespace talus::base
