#include "experiments/rigs/options/rules.h"

#include <cmath>
#include <string_view>

#include "experiments/rigs/options/filling_rule.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {
void RestRule::Validate(base::Problems& problems) const {
  RequirePositive(problems, "energy_fraction", energy_fraction);
  problems.Require(moving_share >= 0 && moving_share < 1, "moving_share", moving_share,
                   "must be in [0, 1)");
  RequirePositive(problems, "hold_time", hold_time);
  RequirePositive(problems, "max_time", max_time);
  problems.Require(!(hold_time > max_time), "hold_time", hold_time, "must not exceed max_time");
}

void PhaseRules::Validate(base::Problems& problems) const {
  RequirePositive(problems, "fill_max_overlap", fill_max_overlap);
  RequirePositive(problems, "fill_max_sweeps", fill_max_sweeps);
  RequirePositive(problems, "leave_depth", leave_depth);
  if (lift_max_time) RequirePositive(problems, "lift_max_time", *lift_max_time);
}

void TapRule::Validate(base::Problems& problems) const {
  RequirePositive(problems, "count", count);
  RequirePositive(problems, "height", height);
  problems.Require(interval > 3 * std::sqrt(2 * height / 9.81), "interval", interval,
                   "must be above three times the time of the fall");
}

void FillingRule::Validate(base::Problems& problems) const {
  const auto check = [&](const char* key, const std::optional<double>& value) {
    if (!value) return;
    problems.Require(kind == FillingKind::kPour, key, "belongs to the kind pour; remove it");
    if (std::string_view(key) == "scatter") {
      problems.Require(*value >= 0 && std::isfinite(*value), key, *value, "must not be negative");
    } else {
      RequirePositive(problems, key, *value);
    }
  };
  check("drop_height", drop_height);
  check("mouth_diameter", mouth_diameter);
  check("rate", rate);
  check("scatter", scatter);
}

}  // namespace talus::rigs
