#include "experiments/campaign/spec/measured_numbers.h"

#include <numbers>
#include <string_view>

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

  template <base::Dimension D>
  void operator()(std::string_view key, const std::optional<MeasuredNumber<D>>& number,
                  base::FieldInfo = {}) {
    if (!number) return;
    const MetricUnit unit = UnitOf(D);
    scalars.push_back({.metric = std::string(key) + unit.suffix,
                       .key = std::string(key),
                       .value = number->value * unit.scale,
                       .standard_error = number->standard_error * unit.scale});
  }
};

}  // namespace

std::vector<ScalarSpec> ScalarsOf(const MeasuredNumbers& numbers) {
  std::vector<ScalarSpec> scalars;
  MeasuredNumbers::Visit(numbers, Collector{scalars});
  return scalars;
}

}  // namespace talus::campaign
