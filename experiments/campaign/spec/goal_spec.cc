#include "experiments/campaign/spec/goal_spec.h"

#include <algorithm>

namespace talus::campaign {
namespace {

const rigs::ObservableInfo* InfoOf(const std::string& key) {
  const auto* found = std::ranges::find_if(
      rigs::kObservables, [&](const rigs::ObservableInfo& info) { return info.key == key; });
  return found == rigs::kObservables.end() ? nullptr : found;
}

}  // namespace

base::Dimension GoalSpec::DimensionOf(const std::string& observable) {
  const rigs::ObservableInfo* info = InfoOf(observable);
  return info == nullptr ? base::Dimension::kNone : info->dimension;
}

void GoalSpec::Validate(base::Problems& problems) const {
  problems.Require(half_width > 0, "half_width", half_width, "must be positive");
  problems.Require(InfoOf(observable) != nullptr, "observable",
                   "is \"" + observable + "\", which no bulk test measures (docs/rigs.md)");
}

std::string GoalSpec::metric() const { return rigs::MetricName(InfoOf(observable)->observable); }

double GoalSpec::half_width_in_results() const {
  return half_width * rigs::MetricUnitOf(DimensionOf(observable)).scale;
}

}  // namespace talus::campaign
