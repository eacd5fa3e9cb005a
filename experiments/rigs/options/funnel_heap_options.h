// A heap that is poured from a funnel, at a fixed height or one that follows, onto a plate.
#pragma once

#include <cmath>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct FunnelHeapOptions {
  double plate_diameter = 0.03;  // [m], > 0
  double rim_height = 0;         // of the plate's rim [m], >= 0
  double height = 0.025;         // of the funnel's outlet above the plate [m], > 0
  double outlet = 0.008;         // its diameter [m], > 0 and below the plate's
  bool follows = false;          // the funnel keeps its height above the heap's top

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("plate_diameter", self.plate_diameter,
          {.dimension = kLength, .doc = "of the plate that the heap stands on, > 0"});
    visit("rim_height", self.rim_height,
          {.dimension = kLength, .doc = "of the plate's rim; default: none, >= 0"});
    visit("height", self.height,
          {.dimension = kLength, .doc = "of the funnel's outlet above the plate, > 0"});
    visit("outlet", self.outlet,
          {.dimension = kLength, .doc = "the outlet's diameter, > 0 and below the plate's"});
    visit("follows", self.follows,
          {.doc = "whether the funnel rises with the heap and keeps its height above the top, in "
                  "place of one above the plate"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "plate_diameter", plate_diameter);
    RequireLength(problems, "height", height);
    RequireLength(problems, "outlet", outlet);
    problems.Require(rim_height >= 0 && std::isfinite(rim_height), "rim_height", rim_height,
                     "must not be negative");
    problems.Require(!(rim_height >= height), "rim_height", rim_height,
                     "must be below the height of the funnel");
    problems.Require(!(outlet >= plate_diameter), "outlet", outlet,
                     "must be below the plate's diameter");
  }
};

}  // namespace talus::rigs
