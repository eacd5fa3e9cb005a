// A box of powder that is tilted until its load slides.
#pragma once

#include <numbers>
#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct TiltingBoxOptions {
  double length = 0.04;  // along the slope [m], > 0
  double width = 0.015;  // [m], > 0
  // At its lower end [m], >= 0; default: as high as the powder needs.
  std::optional<double> lip_height{};
  double rate = 10 * base::kDegree;           // of tilting [rad/s], > 0
  double largest_angle = 60 * base::kDegree;  // where it ends at the latest [rad], in (0, π/2]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("length", self.length, {.dimension = Dimension::kLength, .doc = "along the slope, > 0"});
    visit("width", self.width, {.dimension = Dimension::kLength, .doc = "across it, > 0"});
    visit("lip_height", self.lip_height,
          {.dimension = Dimension::kLength,
           .doc = "of the wall at the lower end, >= 0; default: it holds all the powder"});
    visit("rate", self.rate,
          {.dimension = Dimension::kAngularVelocity, .doc = "of tilting, > 0; default: 10 deg/s"});
    visit("largest_angle", self.largest_angle,
          {.dimension = Dimension::kAngle,
           .doc = "the test ends here at the latest, in (0, 90 deg]; default: 60 deg"});
  }
  void Validate(base::Problems& problems) const {
    RequireLength(problems, "length", length);
    RequireLength(problems, "width", width);
    problems.Require(!lip_height || (*lip_height >= 0 && *lip_height <= kLargestLength),
                     "lip_height", lip_height.value_or(0), "must not be negative, and at most 2 m");
    problems.RequirePositive("rate", rate);
    problems.Require(largest_angle > 0 && largest_angle <= std::numbers::pi / 2, "largest_angle",
                     largest_angle,
                     "must be positive and at most 90 deg; a bare number is in rad: write "
                     "\"60 deg\"");
  }
};

}  // namespace talus::rigs
