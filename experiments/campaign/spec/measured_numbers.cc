#include "experiments/campaign/spec/measured_numbers.h"

#include <string_view>

namespace talus::campaign {
namespace {

// Walks the list and takes what is given.
struct Collector {
  std::vector<ScalarSpec>& scalars;

  template <template <base::Dimension, bool> class Number, base::Dimension D, bool kYesNo>
  void operator()(std::string_view key, const std::optional<Number<D, kYesNo>>& number,
                  base::FieldInfo = {}) {
    if (!number) return;
    const rigs::MetricUnit unit = rigs::MetricUnitOf(D);
    ScalarSpec scalar{.metric = std::string(key) + unit.ending, .key = std::string(key)};
    if constexpr (requires { number->Value(); }) {
      scalar.value = number->Value() * unit.scale;
      scalar.standard_error = number->StandardError() * unit.scale;
      scalar.degrees = number->Degrees();
    } else {
      scalar.standard_error = number->standard_error * unit.scale;
    }
    scalars.push_back(std::move(scalar));
  }
};

template <template <base::Dimension, bool> class Number>
std::vector<ScalarSpec> Collect(const NumbersOf<Number>& numbers) {
  std::vector<ScalarSpec> scalars;
  NumbersOf<Number>::Visit(numbers, Collector{scalars});
  return scalars;
}

}  // namespace

std::vector<ScalarSpec> ScalarsOf(const MeasuredNumbers& numbers) { return Collect(numbers); }

std::vector<ScalarSpec> ScalarsOf(const ExpectedErrors& errors) { return Collect(errors); }

}  // namespace talus::campaign
