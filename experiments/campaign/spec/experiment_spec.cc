#include "experiments/campaign/spec/experiment_spec.h"

#include <cmath>

namespace talus::campaign {

void MeasuredMass::Validate(base::Problems& problems) const {
  problems.Require(value >= 0 && std::isfinite(value), "value", value, "must not be negative");
  problems.Require(standard_error > 0 && std::isfinite(standard_error), "sd", standard_error,
                   "must be positive: a number counts by its error");
}

void ExperimentSpec::Validate(base::Problems& problems) const {
  problems.Require(!name.empty(), "name", "must not be empty");
  images.Validate(problems);
}

std::vector<ScalarSpec> ScalarsOf(const ExperimentSpec& experiment) {
  std::vector<ScalarSpec> scalars;
  const auto add = [&](const char* metric, const std::optional<MeasuredMass>& mass) {
    if (!mass) return;
    scalars.push_back(
        {.metric = metric, .value = mass->value, .standard_error = mass->standard_error});
  };
  add("mass_on_plate_kg", experiment.mass_on_plate);
  add("mass_fallen_kg", experiment.mass_fallen);
  return scalars;
}

}  // namespace talus::campaign
