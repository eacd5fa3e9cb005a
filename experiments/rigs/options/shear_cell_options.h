// A round cell whose bladed lid presses on the powder and turns: a rotational shear cell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct ShearCellOptions {
  static constexpr std::size_t kMostStresses = 3;

  std::vector<double> stresses{1e3, 2e3, 4e3};  // that the lid keeps [Pa], increasing
  double diameter = 0.025;                      // of the cell [m], > 0
  std::optional<double> travel{};               // of the lid at two thirds of its radius [m], > 0
  double speed = 0.02;                          // of the lid there [m/s], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("stresses", self.stresses,
          {.dimension = Dimension::kPressure,
           .doc = "one to three normal stresses that the lid keeps one after the other, its weight "
                  "included, > 0 and increasing; default: 1, 2 and 4 kPa"});
    visit("diameter", self.diameter, {.dimension = Dimension::kLength, .doc = "inner one, > 0"});
    visit("travel", self.travel,
          {.dimension = Dimension::kLength,
           .doc = "of the lid under each stress, at two thirds of its radius, > 0; default: twenty "
                  "(scaled) grain diameters"});
    visit("speed", self.speed, {.dimension = Dimension::kVelocity, .doc = "of the lid there, > 0"});
  }
  void Validate(base::Problems& problems) const {
    ValidateStresses(problems);
    RequireLength(problems, "diameter", diameter);
    if (travel) RequireLength(problems, "travel", *travel);
    problems.RequirePositive("speed", speed);
  }

 private:
  void ValidateStresses(base::Problems& problems) const {
    problems.Require(!stresses.empty(), "stresses",
                     "is empty: a lid without a stress shears nothing; give one to three, such as "
                     "[\"1 kPa\", \"2 kPa\", \"4 kPa\"]");
    problems.Require(stresses.size() <= kMostStresses, "stresses",
                     static_cast<double>(stresses.size()), "stresses, must be three at most");
    for (std::size_t i = 0; i < stresses.size(); ++i) {
      const std::string place = "stresses[" + std::to_string(i) + "]";
      problems.RequirePositive(place, stresses[i]);
      problems.Require(i == 0 || !(stresses[i] <= stresses[i - 1]), place, stresses[i],
                       "must be above the one before: each shears what the last has packed");
    }
  }
};

}  // namespace talus::rigs
