#include "experiments/campaign/spec/possible_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/campaign/spec/plausible_angle.h"

namespace talus::campaign {
namespace {

constexpr double kSteepest = std::numbers::pi / 2;  // [rad]

// What is never 0, so that an error as large as the value says nothing: most often it has another
// unit.
constexpr rigs::Observable kNeverZero[] = {
    rigs::Observable::kBulkDensity,         rigs::Observable::kPouredDensity,
    rigs::Observable::kTappedDensity,       rigs::Observable::kHausnerRatio,
    rigs::Observable::kTappedSolidFraction, rigs::Observable::kHeight,
    rigs::Observable::kColumnHeight,        rigs::Observable::kAspectRatio,
    rigs::Observable::kDischargeTime,       rigs::Observable::kSizeDrift,
    rigs::Observable::kShearStress1,        rigs::Observable::kShearStress2,
    rigs::Observable::kShearStress3};

bool IsNeverZero(std::string_view key) {
  return std::ranges::any_of(kNeverZero,
                             [&](rigs::Observable o) { return rigs::InfoOf(o).key == key; });
}

// Walks the table of observables.
struct Checker {
  const std::string& prefix;
  base::Problems& problems;

  template <base::Dimension D, bool kYesNo>
  void operator()(std::string_view key, const std::optional<MeasuredNumber<D, kYesNo>>& number,
                  const base::FieldInfo& = {}) {
    if (!number) return;
    const std::string place = prefix + std::string(key) + ".";
    if (IsNeverZero(key)) RequireKnown(*number, place, base::SiUnit(D));
    if constexpr (D == base::Dimension::kAngle) {
      ForEach(*number, place, [&](const std::string& one, double value) {
        RequireAngle(problems, one, value, kSteepest);
      });
      RequireErrorOfAngle(*number, place);
    } else if constexpr (D == base::Dimension::kNone) {
      const double most = rigs::BoundsOf(key).high;  // without a unit key and metric are the same
      ForEach(*number, place, [&](const std::string& one, double value) {
        problems.Require(value <= most, one, value,
                         "must be at most 1: it is a share; write \"" + base::ShortNumber(value) +
                             " %\" for percent");
      });
      RequireErrorOfShare(*number, place, most);
    }
  }

  // Calls `body` with the place of each number that is written there, and the number.
  template <class Number, class Body>
  static void ForEach(const Number& number, const std::string& place, Body&& body) {
    if (number.value) body(place + "value", *number.value);
    const std::vector<double> values = number.values.value_or(std::vector<double>{});
    for (std::size_t i = 0; i < values.size(); ++i) {
      body(place + "values[" + std::to_string(i) + "]", values[i]);
    }
  }

  template <class Number>
  void RequireKnown(const Number& number, const std::string& place, std::string_view unit) {
    if (!(number.Value() > 0)) return;  // it is missing, or refused already
    const bool has_scatter = number.values && number.values->size() > 1;
    const std::string value = base::ShortNumber(number.Value()) + (unit.empty() ? "" : " ");
    problems.Require(number.StandardError() < number.Value(),
                     place + (has_scatter ? "values" : "sd"), number.StandardError(),
                     "as a standard error must be below the value, " + value + std::string(unit) +
                         ": has one of them another unit?");
  }

  // Beyond a half an error tells nothing of a share; most often it is in percent.
  template <class Number>
  void RequireErrorOfShare(const Number& number, const std::string& place, double most) {
    constexpr double kMost = 0.5;
    if (most > 1 || (number.values && number.values->size() > 1)) return;
    const double error = number.StandardError();
    problems.Require(error <= kMost, place + "sd", error,
                     "must be at most 0.5: it is the error of a share; write \"" +
                         base::ShortNumber(error) + " %\" for percent");
  }

  // The scatter of values that are each possible tells of one in another unit.
  template <class Number>
  void RequireErrorOfAngle(const Number& number, const std::string& place) {
    const bool has_scatter = number.values && number.values->size() > 1;
    if (!has_scatter) {
      return RequireAngleError(problems, place + "sd", number.StandardError());
    }
    const bool possible =
        std::ranges::all_of(*number.values, [](double value) { return value <= kSteepest; });
    const double error = number.StandardError();
    problems.Require(!possible || error <= kLargestAngleError, place + "values",
                     "have a standard error of " + base::ShortNumber(error / base::kDegree, 2) +
                         " deg; is one of them without its unit? a bare number is in rad");
  }
};

}  // namespace

void RequirePossible(const MeasuredNumbers& numbers, const std::string& prefix,
                     base::Problems& problems) {
  MeasuredNumbers::Visit(numbers, Checker{prefix, problems});
}

}  // namespace talus::campaign
