// A wall as a scene file states it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "base/vec3.h"
#include "engine/wall.h"

namespace talus::engine {

enum class WallKind { kPlane, kDisc, kOpenCylinder, kSolidCylinder };

struct MotionSpec {
  double time = 0;  // [s]
  Vec3 velocity;    // [m/s]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("time", self.time,
          {.dimension = Dimension::kTime, .required = true, .doc = "from which on, increasing"});
    visit("velocity", self.velocity,
          {.dimension = Dimension::kVelocity, .required = true, .doc = "of the wall"});
  }
};

struct WallSpec {
  std::string name;
  WallKind shape = WallKind::kPlane;
  std::string material;  // name; empty: the first
  Vec3 position;         // [m]: point of a plane, centre of a disc, centre of a cylinder's one end
  Vec3 direction{0, 0, 1};           // normal, or axis to the other end; any length
  std::optional<double> diameter{};  // [m], > 0: all but planes
  std::optional<double> length{};    // [m], > 0: cylinders
  std::vector<MotionSpec> motion{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("name", self.name, {.doc = "for messages"});
    visit("shape", self.shape, {.required = true, .doc = "see docs/scene.md"});
    visit("material", self.material, {.doc = "name of a material; default: the first"});
    visit("position", self.position,
          {.dimension = kLength,
           .doc = "point of a plane, centre of a disc, centre of one end of a cylinder"});
    visit("direction", self.direction,
          {.doc = "normal of a plane (towards the spheres) or disc, axis of a cylinder from "
                  "position to the other end; any length but zero"});
    visit("diameter", self.diameter, {.dimension = kLength, .doc = "of a disc or cylinder, > 0"});
    visit("length", self.length, {.dimension = kLength, .doc = "of a cylinder, > 0"});
    visit("motion", self.motion, {.doc = "at rest before the first entry"});
  }
  void Validate(base::Problems& problems) const;

  // The wall of a valid spec; `material_index` as found from the name.
  Wall Build(int material_index) const;
};

}  // namespace talus::engine

template <>
struct talus::base::Names<talus::engine::WallKind> {
  using K = talus::engine::WallKind;
  static constexpr std::array kList{std::pair{"plane", K::kPlane}, std::pair{"disc", K::kDisc},
                                    std::pair{"open_cylinder", K::kOpenCylinder},
                                    std::pair{"solid_cylinder", K::kSolidCylinder}};
};
