// Numbers of one test that cannot all be true: one that follows from the others, two shares of more
// than the whole.
#pragma once

#include <string>

#include "base/problems.h"
#include "experiments/campaign/spec/experiment_spec.h"

namespace talus::campaign {

struct Surroundings {
  std::string prefix;                     // of a number's key: "experiments[1].", or nothing
  std::optional<double> grain_density{};  // [kg/m³]; none where it is searched
  double filled = 0;                      // mass [kg], 0 where it is not known
  std::string filled_by{};                // its key
};

// Adds a problem for every number that contradicts others by several of their errors.
void RequireAgreeing(const ExperimentSpec& experiment, const Surroundings& around,
                     base::Problems& problems);

}  // namespace talus::campaign
