// An upright cylinder with a flat floor or a cone, whose orifice is opened: a flowmeter funnel.
#pragma once

#include <numbers>
#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct OrificeFlowOptions {
  double diameter = 0.03;              // of the cylinder [m], > 0
  double orifice = 0.01;               // its diameter [m], > 0 and below the cylinder's
  std::optional<double> cone_angle{};  // between two opposite sides [rad], in (0, π); default: flat
  double arch_time = 0.5;              // at rest so long, what stands above the orifice [s], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("diameter", self.diameter,
          {.dimension = Dimension::kLength, .doc = "inner one of the cylinder, > 0"});
    visit("orifice", self.orifice,
          {.dimension = Dimension::kLength, .doc = "its diameter, > 0 and below the cylinder's"});
    visit("cone_angle", self.cone_angle,
          {.dimension = Dimension::kAngle,
           .doc = "between opposite sides, in (0, 180 deg); default: a flat floor"});
    visit("arch_time", self.arch_time,
          {.dimension = Dimension::kTime,
           .doc = "powder that has been at rest for so long does not flow any more, > 0"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "diameter", diameter);
    RequireLength(problems, "orifice", orifice);
    problems.RequirePositive("arch_time", arch_time);
    problems.Require(!(orifice >= diameter), "orifice", orifice,
                     "must be below the diameter of the cylinder");
    problems.Require(!cone_angle || (*cone_angle > 0 && *cone_angle < std::numbers::pi),
                     "cone_angle", cone_angle.value_or(0),
                     "must be in (0, 180 deg); a bare number is in rad: write \"60 deg\"");
  }
};

}  // namespace talus::rigs
