// Walls: an analytic shape, a material and a prescribed motion.
#pragma once

#include <optional>
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

// A flat ring without thickness: a disc with a hole. Both faces and both edges touch.
struct Annulus {
  Vec3 center = {};         // [m]
  Vec3 normal{0, 0, 1};     // unit vector
  double inner_radius = 0;  // of the hole [m], > 0
  double radius = 0;        // [m], > inner_radius
};

// A flat rectangle without thickness; both faces and the edges touch.
struct Rectangle {
  Vec3 center = {};      // [m]
  Vec3 normal{0, 0, 1};  // unit vector
  Vec3 edge{1, 0, 0};    // unit vector, perpendicular to the normal: along `width`
  double width = 0;      // [m], > 0
  double height = 0;     // across `edge` [m], > 0
};

// The side of a truncated cone without thickness, open at both ends: a hopper. Both faces and both
// edges touch.
struct Cone {
  Vec3 base = {};         // centre of one end [m]
  Vec3 axis{0, 0, 1};     // unit vector from `base` to the other end
  double radius = 0;      // at the base [m], >= 0
  double top_radius = 0;  // at the other end [m], >= 0, one of the two > 0
  double length = 0;      // [m], > 0
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

using WallShape = std::variant<Plane, Disc, OpenCylinder, SolidCylinder, Annulus, Rectangle, Cone>;

// From `time` on, until the next entry, the wall's pivot moves at `velocity` plus `acceleration`
// times the time since, and the wall turns about the pivot. At rest before the first entry.
struct MotionStep {
  double time = 0;             // [s]
  Vec3 velocity = {};          // [m/s]
  Vec3 acceleration = {};      // [m/s²]
  Vec3 angular_velocity = {};  // [rad/s]
};

// From `time` on, until the next entry, a vector turns so; at rest before the first.
struct TurnStep {
  double time = 0;             // [s]
  Vec3 angular_velocity = {};  // [rad/s]
};

struct Wall {
  std::string name;
  WallShape shape;                          // where it is at time 0
  int material = 0;                         // index into Scene::materials
  std::vector<MotionStep> motion = {};      // times increasing
  std::optional<Vec3> pivot = {};           // it turns about, at time 0 [m]; default: its place
  std::optional<double> removal_time = {};  // from which on it is not there any more [s], > 0
};

}  // namespace talus::engine
