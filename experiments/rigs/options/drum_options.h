// A drum, partly filled, that turns about its level axis.
#pragma once

#include <cmath>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct DrumOptions {
  double diameter = 0.06;    // [m], > 0
  double width = 0.014;      // along the axis [m], > 0
  double speed = 10 * kRpm;  // [rad/s], > 0
  double start_turns = 0.5;  // before the surface is measured [-], >= 0
  double turns = 0.5;        // over which it is measured [-], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("diameter", self.diameter, {.dimension = Dimension::kLength, .doc = "inner one, > 0"});
    visit("width", self.width, {.dimension = Dimension::kLength, .doc = "along the axis, > 0"});
    visit("speed", self.speed,
          {.dimension = Dimension::kAngularVelocity,
           .doc = "at which it turns, > 0; default: 10 rpm"});
    visit("start_turns", self.start_turns, {.doc = "before the surface is measured, >= 0"});
    visit("turns", self.turns, {.doc = "over which the angle is the mean, > 0"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "diameter", diameter);
    RequireLength(problems, "width", width);
    problems.Require(speed > 0 && std::isfinite(speed), "speed", speed, "must be positive");
    problems.Require(start_turns >= 0 && std::isfinite(start_turns), "start_turns", start_turns,
                     "must not be negative");
    problems.Require(turns > 0 && std::isfinite(turns), "turns", turns, "must be positive");
  }
};

}  // namespace talus::rigs
