// Walls: an analytic shape, a material and a prescribed motion.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/vec3.h"

namespace talus::engine {

using base::Vec3;

// The half space behind a plane is solid: spheres stay on the side that `normal` points to.
struct Plane {
  Vec3 point = {};       // [m]
  Vec3 normal{0, 0, 1};  // unit vector
};

// A flat disc without thickness; both faces and the edge touch.
struct Disc {
  Vec3 center = {};      // [m]
  Vec3 normal{0, 0, 1};  // unit vector
  double radius = 0;     // [m], > 0
};

// A tube without thickness, open at both ends; inner and outer face and both edges touch.
struct OpenCylinder {
  Vec3 base = {};      // centre of one end [m]
  Vec3 axis{0, 0, 1};  // unit vector from `base` to the other end
  double radius = 0;   // [m], > 0
  double length = 0;   // [m], > 0
};

// A solid cylinder; end faces, rims and side touch.
struct SolidCylinder {
  Vec3 base = {};      // centre of one end face [m]
  Vec3 axis{0, 0, 1};  // unit vector from `base` to the other end
  double radius = 0;   // [m], > 0
  double length = 0;   // [m], > 0
};

using WallShape = std::variant<Plane, Disc, OpenCylinder, SolidCylinder>;

// From `time` on, until the next entry, the wall moves at `velocity`; at rest before the first.
struct MotionStep {
  double time = 0;     // [s]
  Vec3 velocity = {};  // [m/s]
};

struct Wall {
  std::string name;
  WallShape shape;                      // where it is at time 0
  int material = 0;                     // index into Scene::materials
  std::vector<MotionStep> motion = {};  // times increasing
};

}  // namespace talus::engine
