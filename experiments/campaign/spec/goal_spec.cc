#include "experiments/campaign/spec/goal_spec.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/nearest.h"
#include "experiments/campaign/spec/plausible_angle.h"

namespace talus::campaign {
namespace {

// By its key, or by its name in results.
const rigs::ObservableInfo* InfoOf(const std::string& name) {
  const auto* found =
      std::ranges::find_if(rigs::kObservables, [&](const rigs::ObservableInfo& info) {
        return info.key == name || rigs::MetricName(info.observable) == name;
      });
  return found == rigs::kObservables.end() ? nullptr : found;
}

// That is a kind of it: "angle_of_repose_1" of "angle_of_repose".
const rigs::ObservableInfo* KindOf(const std::string& name) {
  const auto* found =
      std::ranges::find_if(rigs::kObservables, [&](const rigs::ObservableInfo& info) {
        return std::string_view(info.key).starts_with(name + "_");
      });
  return found == rigs::kObservables.end() ? nullptr : found;
}

std::string DidYouMean(const std::string& name) {
  std::vector<std::string> keys;
  for (const rigs::ObservableInfo& info : rigs::kObservables) keys.emplace_back(info.key);
  return base::DidYouMean(name, keys);
}

}  // namespace

base::Dimension GoalSpec::DimensionOf(const std::string& observable) {
  const rigs::ObservableInfo* info = InfoOf(observable);
  if (info == nullptr) info = KindOf(observable);  // its unit is right where the name is not
  return info == nullptr ? base::Dimension::kNone : info->dimension;
}

void GoalSpec::Validate(base::Problems& problems) const {
  problems.Require(half_width > 0, "half_width", half_width, "must be positive");
  if (DimensionOf(observable) == base::Dimension::kAngle) {
    RequireAngleError(problems, "half_width", half_width);
  }
  problems.Require(InfoOf(observable) != nullptr, "observable",
                   "is \"" + observable + "\", which no bulk test measures (docs/rigs.md)" +
                       DidYouMean(observable));
}

std::string GoalSpec::metric() const { return rigs::MetricName(InfoOf(observable)->observable); }

double GoalSpec::half_width_in_results() const {
  return half_width * rigs::MetricUnitOf(DimensionOf(observable)).scale;
}

}  // namespace talus::campaign
