// A wall as a scene file states it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "base/vec3.h"
#include "engine/bodies/wall.h"

namespace talus::engine {

enum class WallKind { kPlane, kDisc, kOpenCylinder, kSolidCylinder, kAnnulus, kRectangle, kCone };
constexpr WallKind LastOf(WallKind) { return WallKind::kCone; }

struct MotionSpec {
  double time = 0;        // [s]
  Vec3 velocity;          // [m/s]
  Vec3 acceleration;      // [m/s²]
  Vec3 angular_velocity;  // [rad/s]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("time", self.time,
          {.dimension = Dimension::kTime, .required = true, .doc = "from which on, increasing"});
    visit("velocity", self.velocity,
          {.dimension = Dimension::kVelocity, .doc = "of the wall's pivot"});
    visit(
        "acceleration", self.acceleration,
        {.dimension = Dimension::kAcceleration, .doc = "from `time` on; the last entry has none"});
    visit("angular_velocity", self.angular_velocity,
          {.dimension = Dimension::kAngularVelocity, .doc = "about the pivot; not of a plane"});
  }
};

// A tapping device lifts the wall against gravity and lets it fall, again and again.
struct TapSpec {
  double start = 0;     // [s], >= 0
  int count = 0;        // > 0
  double height = 0;    // [m], > 0
  double interval = 0;  // [s], above the time that one takes

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("start", self.start, {.dimension = Dimension::kTime, .doc = "of the first, >= 0"});
    visit("count", self.count, {.required = true, .doc = "> 0"});
    visit("height", self.height,
          {.dimension = Dimension::kLength, .required = true, .doc = "of each fall, > 0"});
    visit("interval", self.interval,
          {.dimension = Dimension::kTime,
           .required = true,
           .doc = "from tap to tap; above three times the time of the fall"});
  }
};

struct WallSpec {
  std::string name;
  WallKind shape = WallKind::kPlane;
  std::string material;  // name; empty: the first
  Vec3 position;         // [m]: point of a plane, centre of a disc, centre of a cylinder's one end
  Vec3 direction{0, 0, 1};           // normal, or axis to the other end; any length
  std::optional<double> diameter{};  // [m], > 0, of a cone >= 0: all but planes and rectangles
  std::optional<double> length{};    // [m], > 0: cylinders, cones
  std::optional<double> inner_diameter{};  // [m], > 0: annuli
  std::optional<double> end_diameter{};    // [m], >= 0: cones, at the far end
  std::optional<double> width{};           // [m], > 0: rectangles, along the edge
  std::optional<double> height{};          // [m], > 0: rectangles, across it
  std::optional<Vec3> edge{};              // rectangles; any length
  std::vector<MotionSpec> motion{};
  std::optional<TapSpec> taps{};
  std::optional<Vec3> pivot{};         // [m]
  std::optional<double> removed_at{};  // [s], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("name", self.name, {.doc = "for messages, and for the columns of series.csv"});
    visit("shape", self.shape, {.required = true, .doc = "see docs/scene.md"});
    visit("material", self.material, {.doc = "name of a material; default: the first"});
    visit(
        "position", self.position,
        {.dimension = kLength,
         .doc = "point of a plane, centre of a disc, annulus or rectangle, centre of one end of a "
                "cylinder or cone"});
    visit("direction", self.direction,
          {.doc = "normal of a plane (towards the spheres), disc, annulus or rectangle, axis of a "
                  "cylinder or cone from position to the other end; any length but zero"});
    visit("diameter", self.diameter,
          {.dimension = kLength,
           .doc = "of a disc, annulus or cylinder, > 0; of a cone at its position, >= 0"});
    visit("length", self.length, {.dimension = kLength, .doc = "of a cylinder or cone, > 0"});
    visit("inner_diameter", self.inner_diameter,
          {.dimension = kLength, .doc = "of an annulus' hole, > 0"});
    visit("end_diameter", self.end_diameter,
          {.dimension = kLength, .doc = "of a cone at its other end, >= 0"});
    visit("width", self.width, {.dimension = kLength, .doc = "of a rectangle along `edge`, > 0"});
    visit("height", self.height, {.dimension = kLength, .doc = "of a rectangle across it, > 0"});
    visit(
        "edge", self.edge,
        {.doc = "direction of a rectangle's width; default: x, or y where the normal is along x"});
    visit("motion", self.motion, {.doc = "at rest before the first entry"});
    visit("taps", self.taps, {.doc = "in place of `motion`: lifted and let fall"});
    visit("pivot", self.pivot,
          {.dimension = kLength, .doc = "that the wall turns about; default: its position"});
    visit("removed_at", self.removed_at,
          {.dimension = base::Dimension::kTime, .doc = "the wall is not there from then on, > 0"});
  }
  void Validate(base::Problems& problems) const;

  // The wall of a valid spec; `material_index` as found from the name.
  Wall Build(int material_index, const Vec3& gravity) const;
};

}  // namespace talus::engine
