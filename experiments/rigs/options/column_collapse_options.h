// A column behind a gate in a channel; the gate opens and the column runs out over the floor.
#pragma once

#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct ColumnCollapseOptions {
  double length = 0.02;                   // of the column, from the end wall to the gate [m], > 0
  double width = 0.01;                    // of the channel [m], > 0
  std::optional<double> gate_velocity{};  // [m/s], > 0; default: gone at once

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("length", self.length,
          {.dimension = Dimension::kLength, .doc = "of the column, from end wall to gate, > 0"});
    visit("width", self.width, {.dimension = Dimension::kLength, .doc = "of the channel, > 0"});
    visit("gate_velocity", self.gate_velocity,
          {.dimension = Dimension::kVelocity,
           .doc = "at which the gate is lifted, > 0; default: it is gone at once"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "length", length);
    RequireLength(problems, "width", width);
    problems.RequirePositive("gate_velocity", gate_velocity);
  }
};

}  // namespace talus::rigs
