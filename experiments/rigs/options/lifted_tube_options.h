// A tube full of powder that is lifted off a plate (docs/physics.md, 7). Its keys stand under
// `device`.
#pragma once

#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

enum class PlateKind { kSolidCylinder, kDisc };
constexpr PlateKind LastOf(PlateKind) { return PlateKind::kDisc; }

struct LiftedTubeOptions {
  double tube_inner_diameter = 0.01;    // D_i [m], > 0
  std::optional<double> tube_length{};  // [m]; default: what the mass needs when loosely poured
  double plate_diameter = 0.01;         // D_b [m], > 0
  PlateKind plate = PlateKind::kSolidCylinder;
  double plate_height = 0.005;  // of the solid cylinder [m], > 0
  double lift_velocity = 0.01;  // v_l [m/s], > 0

  bool operator==(const LiftedTubeOptions&) const = default;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("tube_inner_diameter", self.tube_inner_diameter,
          {.dimension = Dimension::kLength, .doc = "of the lifted tube, > 0"});
    visit("tube_length", self.tube_length,
          {.dimension = Dimension::kLength, .doc = "default: what the mass needs"});
    visit("plate_diameter", self.plate_diameter,
          {.dimension = Dimension::kLength, .doc = "that the heap stands on, > 0"});
    visit("plate", self.plate,
          {.doc = "solid_cylinder: its rim and side are walls too; disc: no thickness"});
    visit("plate_height", self.plate_height,
          {.dimension = Dimension::kLength, .doc = "of the solid cylinder, > 0"});
    visit("lift_velocity", self.lift_velocity,
          {.dimension = Dimension::kVelocity, .doc = "of the tube, > 0"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "tube_inner_diameter", tube_inner_diameter);
    RequireLength(problems, "plate_diameter", plate_diameter);
    problems.RequirePositive("plate_height", plate_height);
    problems.RequirePositive("lift_velocity", lift_velocity);
    problems.RequirePositive("tube_length", tube_length);
    problems.Require(!(tube_inner_diameter > plate_diameter), "tube_inner_diameter",
                     tube_inner_diameter,
                     "must not be above plate_diameter: the tube stands on it");
  }
};

}  // namespace talus::rigs
