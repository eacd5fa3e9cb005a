// Numbers that an experiment has measured, beside its images or without any.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "base/sample.h"
#include "experiments/campaign/spec/plausible_angle.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::campaign {

// A number with the error of what is given (of the mean, where it is a mean), or the values that
// were measured, two or more. D is its dimension, kYesNo whether it is seen as 0 or 1.
template <base::Dimension D, bool kYesNo = false>
struct MeasuredNumber {
  std::optional<double> value{};                // SI, >= 0
  std::optional<double> standard_error{};       // SI, > 0
  std::optional<std::vector<double>> values{};  // SI, >= 0, in place of the two

  double Value() const { return values ? base::SampleOf(*values).mean : value.value_or(0); }
  // A yes or no that was the same each time has the error of one, over the root of their number.
  double StandardError() const {
    if (!values || values->size() < 2) return standard_error.value_or(0);
    const double scatter = base::SampleOf(*values).StandardError();
    return IsAlike() ? rigs::kYesNoError / std::sqrt(static_cast<double>(values->size())) : scatter;
  }
  // How many degrees of freedom the error has; 0: it is stated.
  int Degrees() const {
    return values && values->size() > 1 && !IsAlike() ? static_cast<int>(values->size()) - 1 : 0;
  }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("value", self.value,
          {.dimension = D, .doc = "what was measured, >= 0; needed without values"});
    visit("sd", self.standard_error,
          {.dimension = D,
           .doc = "standard error of the value given, > 0; needed beside it",
           .unit_of = "value"});
    visit("values", self.values,
          {.dimension = D,
           .doc = "in place of value and sd: every measurement, two or more, whose mean and "
                  "standard error count",
           .unit_of = "values"});
  }
  void Validate(base::Problems& problems) const {
    if (values) return ValidateValues(problems);
    problems.Require(value.has_value(), "value", "is missing");
    problems.Require(standard_error.has_value(), "sd", "is missing");
    problems.Require(!value || (*value >= 0 && std::isfinite(*value)), "value", value.value_or(0),
                     "must not be negative");
    ValidateError(problems);
  }

 private:
  // The mean of equal numbers may differ from them in its last bit.
  // Whatever units it is given in: "5.07 mg" and "5070 ug" differ by a last digit.
  bool IsOneValue() const {
    constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
    const auto [least, most] = std::ranges::minmax(*values);
    return most - least <= kRounding * most;
  }
  bool IsAlike() const { return kYesNo && IsOneValue(); }
  void ValidateError(base::Problems& problems) const {
    problems.Require(!standard_error || (*standard_error > 0 && std::isfinite(*standard_error)),
                     "sd", standard_error.value_or(0),
                     "must be positive: a number counts by its error");
  }
  void ValidateValues(base::Problems& problems) const {
    problems.Require(!value, "values", "stands beside value: give one of the two");
    problems.Require(!values->empty(), "values", "is empty: give every measurement");
    for (const double one : *values) {
      problems.Require(one >= 0 && std::isfinite(one), "values", one, "must not be negative");
    }
    if (values->size() == 1) {
      problems.Require(standard_error.has_value(), "values",
                       "is one number, which has no scatter: give its sd, or measure once more");
      return ValidateError(problems);
    }
    problems.Require(!standard_error, "sd",
                     "stands beside values, whose scatter gives it: give one of the two");
    problems.Require(values->empty() || kYesNo || !IsOneValue(), "values",
                     "are all the same, which no error can be read from: give value and sd");
  }
};

// The error alone, of a number that would be measured.
template <base::Dimension D, bool = false>
struct ExpectedError {
  double standard_error = 0;  // SI, > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("sd", self.standard_error,
          {.dimension = D, .required = true, .doc = "standard error it would have, > 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.RequirePositive("sd", standard_error);
    if constexpr (D == base::Dimension::kAngle) RequireAngleError(problems, "sd", standard_error);
  }
};

// One of each observable (rigs/observables/observable.h), under its key.
template <template <base::Dimension, bool> class Number>
class NumbersOf {
 public:
  template <rigs::Observable O>
  auto& Of() {
    return std::get<static_cast<std::size_t>(O)>(numbers_);
  }

  template <rigs::Observable O>
  const auto& Of() const {
    return std::get<static_cast<std::size_t>(O)>(numbers_);
  }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visit(rigs::kObservables[I].key, std::get<I>(self.numbers_),
             base::FieldInfo{.doc = rigs::kObservables[I].doc}),
       ...);
    }
    (Indices{});
  }

 private:
  using Indices = std::make_index_sequence<rigs::kObservables.size()>;

  template <std::size_t I>
  using Optional =
      std::optional<Number<rigs::kObservables[I].dimension,
                           rigs::kObservables[I].observable == rigs::Observable::kFlows>>;

  template <std::size_t... I>
  static auto Optionals(std::index_sequence<I...>) -> std::tuple<Optional<I>...>;

  decltype(Optionals(Indices{})) numbers_{};
};
using MeasuredNumbers = NumbersOf<MeasuredNumber>;
using ExpectedErrors = NumbersOf<ExpectedError>;

// A number of an experiment under the name of the metric that trials are measured by.
struct ScalarSpec {
  std::string metric;  // "mass_fallen_kg"
  std::string key;     // "mass_fallen"
  double value = 0;    // in the metric's unit, as the error
  double standard_error = 0;
  int degrees = 0;  // of freedom that the error has (journal::ScalarRecord)
};
std::vector<ScalarSpec> ScalarsOf(const MeasuredNumbers& numbers);
// Without values.
std::vector<ScalarSpec> ScalarsOf(const ExpectedErrors& errors);

}  // namespace talus::campaign
