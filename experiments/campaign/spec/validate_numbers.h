// What an experiment's rig must have and do for the numbers that are, or will be, measured on it.
#pragma once

#include <string>
#include <vector>

#include "base/problems.h"
#include "experiments/campaign/spec/experiment_spec.h"

namespace talus::campaign {

// Each is one that the rig measures.
void ValidateMeasured(const ExperimentSpec& e, const std::vector<ScalarSpec>& numbers,
                      const std::string& place, base::Problems& problems);

// A camera, or enough normal stresses, where a number needs them.
void ValidateNeeds(const ExperimentSpec& e, const std::vector<ScalarSpec>& numbers,
                   const std::string& place, base::Problems& problems);

}  // namespace talus::campaign
