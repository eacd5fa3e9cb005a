// Numbers that an experiment has measured, beside its images or without any.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/observables/observable.h"

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

// One of each observable (rigs/observables/observable.h), under its key.
template <template <base::Dimension> class Number>
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

  template <std::size_t... I>
  static auto Optionals(std::index_sequence<I...>)
      -> std::tuple<std::optional<Number<rigs::kObservables[I].dimension>>...>;

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
};
std::vector<ScalarSpec> ScalarsOf(const MeasuredNumbers& numbers);
// Without values.
std::vector<ScalarSpec> ScalarsOf(const ExpectedErrors& errors);

}  // namespace talus::campaign
