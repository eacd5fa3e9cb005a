// A drum, partly filled, that turns about its level axis.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

// Solid fraction of what a picture of a turning drum shows as powder, looser than its bed: a pixel
// is dark where any grain stands between front and back (docs/rigs.md).
inline constexpr double kSeenSolidFraction = 0.52;

struct DrumOptions {
  double diameter = 0.06;        // [m], > 0
  double width = 0.014;          // along the axis [m], > 0
  double speed = 10 * kRpm;      // [rad/s], > 0
  double start_turns = 0.5;      // before the surface is measured [-], >= 0
  double turns = 0.5;            // over which it is measured [-], > 0
  std::optional<double> fill{};  // share of the disc that shows powder [-], in (0, 0.6]: the mass

  // Volume of the grains that fill it so [m³].
  double GrainVolume() const {
    const double disc = std::numbers::pi / 4 * diameter * diameter;
    return fill.value_or(0) * kSeenSolidFraction * disc * width;
  }

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
    visit("fill", self.fill,
          {.doc = "in place of a mass: share of the disc that shows powder, in (0, 0.6]; default: "
                  "the mass, or what the drum's photographs show"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "diameter", diameter);
    RequireLength(problems, "width", width);
    problems.RequirePositive("speed", speed);
    problems.Require(start_turns >= 0 && std::isfinite(start_turns), "start_turns", start_turns,
                     "must not be negative");
    problems.Require(!fill || (*fill > 0 && *fill <= 0.6), "fill", fill.value_or(0),
                     "must be positive and at most 0.6, the share of the drum that is full");
    problems.RequirePositive("turns", turns);
  }
};

}  // namespace talus::rigs
