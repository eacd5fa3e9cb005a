// Numbers that an experiment has measured, beside its images or without any.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"

namespace talus::campaign {

// A number with the error of what is given (of the mean, where it is a mean). D is its dimension.
template <base::Dimension D>
struct MeasuredNumber {
  double value = 0;           // SI
  double standard_error = 0;  // SI, > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("value", self.value,
          {.dimension = D, .required = true, .doc = "what was measured, >= 0"});
    visit("sd", self.standard_error,
          {.dimension = D, .required = true, .doc = "standard error of the value given, > 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.Require(value >= 0 && std::isfinite(value), "value", value, "must not be negative");
    problems.Require(standard_error > 0 && std::isfinite(standard_error), "sd", standard_error,
                     "must be positive: a number counts by its error");
  }
};

// The error alone, of a number that would be measured.
template <base::Dimension D>
struct ExpectedError {
  double standard_error = 0;  // SI, > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("sd", self.standard_error,
          {.dimension = D, .required = true, .doc = "standard error it would have, > 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.Require(standard_error > 0 && std::isfinite(standard_error), "sd", standard_error,
                     "must be positive");
  }
};

// One line each: the key and the dimension make the name of the metric that trials are measured by
// (ScalarsOf).
template <template <base::Dimension> class Number>
struct NumbersOf {
  using Dimension = base::Dimension;
  std::optional<Number<Dimension::kMass>> mass_on_plate{}, mass_fallen{}, mass_left{};
  std::optional<Number<Dimension::kDensity>> poured_density{}, tapped_density{};
  std::optional<Number<Dimension::kNone>> hausner_ratio{};
  std::optional<Number<Dimension::kLength>> runout{}, height{};
  std::optional<Number<Dimension::kTime>> discharge_time{};
  std::optional<Number<Dimension::kMassRate>> discharge_rate{};
  std::optional<Number<Dimension::kAngle>> angle{}, shear_angle{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("mass_on_plate", self.mass_on_plate, {.doc = "of the heap that stays on the plate"});
    visit("mass_fallen", self.mass_fallen,
          {.doc = "of the powder that fell over the rim, or through the slot"});
    visit("mass_left", self.mass_left,
          {.doc = "of the powder that stayed above the slot, or left the tilted box"});
    visit("poured_density", self.poured_density, {.doc = "bulk density as poured"});
    visit("tapped_density", self.tapped_density, {.doc = "bulk density after the taps"});
    visit("hausner_ratio", self.hausner_ratio, {.doc = "tapped over poured density"});
    visit("runout", self.runout, {.doc = "of the collapsed column, from its front"});
    visit("height", self.height, {.doc = "of the collapsed column"});
    visit("discharge_time", self.discharge_time, {.doc = "until 95 % of what runs out has passed"});
    visit("discharge_rate", self.discharge_rate, {.doc = "through the slot"});
    visit("angle", self.angle, {.doc = "of repose, sliding or the drum's surface (docs/rigs.md)"});
    visit("shear_angle", self.shear_angle, {.doc = "of the slopes above the slot"});
  }
};
using MeasuredNumbers = NumbersOf<MeasuredNumber>;
using ExpectedErrors = NumbersOf<ExpectedError>;

// A number of an experiment under the name of the metric that trials are measured by.
struct ScalarSpec {
  std::string metric;  // "mass_fallen_kg"
  std::string key;     // "mass_fallen"
  double value = 0;    // in the metric's unit, as the error
  double standard_error = 0;
};
std::vector<ScalarSpec> ScalarsOf(const MeasuredNumbers& numbers);
// Without values.
std::vector<ScalarSpec> ScalarsOf(const ExpectedErrors& errors);

}  // namespace talus::campaign
