// A box whose floor has a slot; the powder runs through it and heaps up below.
#pragma once

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct DrawDownOptions {
  double length = 0.06;  // of both boxes, across the slot [m], > 0
  double width = 0.01;   // along the slot [m], > 0
  double slot = 0.012;   // its opening [m], > 0
  double height = 0.03;  // of the slot above the lower floor [m], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("length", self.length, {.dimension = kLength, .doc = "of the box across the slot, > 0"});
    visit("width", self.width, {.dimension = kLength, .doc = "of the box along the slot, > 0"});
    visit("slot", self.slot,
          {.dimension = kLength, .doc = "opening of the slot, > 0 and below the length"});
    visit("height", self.height, {.dimension = kLength, .doc = "of the slot above the floor, > 0"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "length", length);
    RequireLength(problems, "width", width);
    RequireLength(problems, "slot", slot);
    RequireLength(problems, "height", height);
    problems.Require(!(slot >= length), "slot", slot, "must be below the length of the box");
  }
};

}  // namespace talus::rigs
