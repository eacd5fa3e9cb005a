#include "experiments/campaign/spec/possible_numbers.h"

#include <numbers>
#include <string_view>

#include "base/text/number_text.h"

namespace talus::campaign {
namespace {

constexpr double kSteepest = std::numbers::pi / 2;  // [rad]
constexpr double kLargestAngleError = 0.5;          // [rad]

// Walks the table of observables.
struct Checker {
  const std::string& prefix;
  base::Problems& problems;

  template <base::Dimension D>
  void operator()(std::string_view key, const std::optional<MeasuredNumber<D>>& number,
                  const base::FieldInfo& = {}) {
    if (!number) return;
    const std::string place = prefix + std::string(key) + ".";
    const std::string value = place + (number->values ? "values" : "value");
    if constexpr (D == base::Dimension::kAngle) {
      RequireAngle(value, number->Value(), kSteepest);
      RequireAngle(number->values ? value : place + "sd", number->StandardError(),
                   kLargestAngleError);
    } else if constexpr (D == base::Dimension::kNone) {
      const double most = rigs::BoundsOf(key).high;  // without a unit key and metric are the same
      problems.Require(number->Value() <= most, value, number->Value(),
                       "must be at most 1: it is a share; write \"" +
                           base::ShortNumber(number->Value()) + " %\" for percent");
    }
  }

  void RequireAngle(const std::string& place, double value, double most) {
    problems.Require(value <= most, place, value,
                     "in rad, which is " + base::ShortNumber(value * 180 / std::numbers::pi) +
                         " degrees; a bare number is in rad: write \"" + base::ShortNumber(value) +
                         " deg\" for degrees");
  }
};

}  // namespace

void RequirePossible(const MeasuredNumbers& numbers, const std::string& prefix,
                     base::Problems& problems) {
  MeasuredNumbers::Visit(numbers, Checker{prefix, problems});
}

}  // namespace talus::campaign
