// A blade that spreads a heap of powder over a build plate, in a strip between two side walls.
#pragma once

#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct SpreadingOptions {
  std::optional<double> gap{};  // below the blade [m], > 0; default: three D90 of the powder
  double speed = 0.05;          // of the blade [m/s], > 0
  double length = 0.01;         // of the build plate along its path [m], > 0
  double width = 0.002;         // of the strip [m], > 0
  double feed = 0.004;          // length of the platform that the heap stands on [m], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("gap", self.gap,
          {.dimension = Dimension::kLength,
           .doc = "between blade and build plate, > 0; default: three D90 of the true powder"});
    visit("speed", self.speed, {.dimension = Dimension::kVelocity, .doc = "of the blade, > 0"});
    visit("length", self.length,
          {.dimension = Dimension::kLength, .doc = "of the build plate along the path, > 0"});
    visit("width", self.width,
          {.dimension = Dimension::kLength, .doc = "of the strip between its side walls, > 0"});
    visit("feed", self.feed,
          {.dimension = Dimension::kLength,
           .doc = "length of the platform that the heap stands on before the plate, > 0"});
  }
  void Validate(base::Problems& problems) const {
    if (gap) RequireLength(problems, "gap", *gap);
    RequirePositive(problems, "speed", speed);
    RequireLength(problems, "length", length);
    RequireLength(problems, "width", width);
    RequireLength(problems, "feed", feed);
  }
};

}  // namespace talus::rigs
