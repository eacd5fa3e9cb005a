// Shear stresses beside the normal stresses that they were measured at: a stress in kPa that is
// read in Pa, stresses in another order than the rig's, an angle that is not theirs.
#pragma once

#include <string>

#include "base/problems.h"
#include "experiments/campaign/spec/experiment_spec.h"

namespace talus::campaign {

// What a shear cell measured; nothing where the experiment is none. `prefix` stands before a
// number's key: "experiments[1].", or nothing.
void CheckStresses(const ExperimentSpec& experiment, const std::string& prefix,
                   base::Problems& problems);

}  // namespace talus::campaign
