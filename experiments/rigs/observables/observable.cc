#include "experiments/rigs/observables/observable.h"

#include "base/units.h"

namespace talus::rigs {
namespace {

constexpr bool InTheEnumsOrder() {
  for (std::size_t i = 0; i < kObservables.size(); ++i) {
    if (kObservables[i].observable != static_cast<Observable>(i)) return false;
  }
  return true;
}
static_assert(InTheEnumsOrder());
static_assert(kObservables.size() == static_cast<std::size_t>(LastOf(Observable{})) + 1);

}  // namespace

MetricUnit MetricUnitOf(base::Dimension dimension) {
  switch (dimension) {
    case base::Dimension::kMass:
      return {"_kg", "kg"};
    case base::Dimension::kDensity:
      return {"_kg_per_m3", "kg/m3"};
    case base::Dimension::kLength:
      return {"_m", "m"};
    case base::Dimension::kTime:
      return {"_s", "s"};
    case base::Dimension::kMassRate:
      return {"_kg_per_s", "kg/s"};
    case base::Dimension::kAreaDensity:
      return {"_kg_per_m2", "kg/m2"};
    case base::Dimension::kPressure:
      return {"_pa", "Pa"};
    case base::Dimension::kAngle:
      return {"_deg", "deg", 1 / base::kDegree};
    default:
      return {};
  }
}

std::string MetricName(Observable observable) {
  const ObservableInfo& info = InfoOf(observable);
  return std::string(info.key) + MetricUnitOf(info.dimension).ending;
}

const ObservableInfo* FindObservable(std::string_view metric) {
  for (const ObservableInfo& info : kObservables) {
    if (MetricName(info.observable) == metric) return &info;
  }
  return nullptr;
}

Bounds BoundsOf(std::string_view metric) {
  const ObservableInfo* info = FindObservable(metric);
  if (info == nullptr) return kAnyNumber;
  const double scale = MetricUnitOf(info->dimension).scale;
  return {.low = scale * info->bounds.low, .high = scale * info->bounds.high};
}

std::string UnitOfObservable(std::string_view metric) {
  const ObservableInfo* info = FindObservable(metric);
  return info != nullptr ? MetricUnitOf(info->dimension).text : "-";
}

}  // namespace talus::rigs
