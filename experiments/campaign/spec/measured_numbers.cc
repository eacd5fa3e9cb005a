#include "experiments/campaign/spec/measured_numbers.h"

#include <numbers>
#include <string_view>
#include <utility>

namespace talus::campaign {
namespace {

struct MetricUnit {
  std::string suffix;  // of a metric's name
  double scale = 1;    // from SI
};

MetricUnit UnitOf(base::Dimension dimension) {
  switch (dimension) {
    case base::Dimension::kMass:
      return {"_kg"};
    case base::Dimension::kDensity:
      return {"_kg_per_m3"};
    case base::Dimension::kLength:
      return {"_m"};
    case base::Dimension::kTime:
      return {"_s"};
    case base::Dimension::kMassRate:
      return {"_kg_per_s"};
    case base::Dimension::kAngle:
      return {"_deg", 180 / std::numbers::pi};
    default:
      return {};
  }
}

// Walks the list and takes what is given.
struct Collector {
  std::vector<ScalarSpec>& scalars;

  template <template <base::Dimension> class Number, base::Dimension D>
  void operator()(std::string_view key, const std::optional<Number<D>>& number,
                  base::FieldInfo = {}) {
    if (!number) return;
    const MetricUnit unit = UnitOf(D);
    ScalarSpec scalar{.metric = std::string(key) + unit.suffix,
                      .key = std::string(key),
                      .standard_error = number->standard_error * unit.scale};
    if constexpr (requires { number->value; }) scalar.value = number->value * unit.scale;
    scalars.push_back(std::move(scalar));
  }
};

template <template <base::Dimension> class Number>
std::vector<ScalarSpec> Collect(const NumbersOf<Number>& numbers) {
  std::vector<ScalarSpec> scalars;
  NumbersOf<Number>::Visit(numbers, Collector{scalars});
  return scalars;
}

}  // namespace

std::vector<ScalarSpec> ScalarsOf(const MeasuredNumbers& numbers) { return Collect(numbers); }

std::vector<ScalarSpec> ScalarsOf(const ExpectedErrors& errors) { return Collect(errors); }

}  // namespace talus::campaign
