#include "experiments/campaign/spec/experiment_spec.h"

#include "base/text/name.h"

namespace talus::campaign {

void ExperimentSpec::Validate(base::Problems& problems) const {
  base::RequireName(problems, "name", name);
  problems.Require(weight > 0 && weight <= 100, "weight", weight,
                   "must be positive, and at most 100; leave the experiment out instead of 0");
  const bool has_numbers = !ScalarsOf(*this).empty();
  problems.Require(images.HasImages() || has_numbers, "",
                   "has no data: give photos, runs or a map, or numbers with their errors such as "
                   "\"mass_fallen\": {\"value\": \"21 mg\", \"sd\": \"2 mg\"}");
  if (images.HasImages()) images.Validate(problems);
}

}  // namespace talus::campaign
