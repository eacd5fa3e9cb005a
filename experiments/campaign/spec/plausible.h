// What no bench has: most often a number whose unit was left out, or one in another column.
#pragma once

#include <vector>

#include "base/problems.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {

// The grains' density, at most: the largest that is searched, or the material's [kg/m³].
double MostDensity(const CampaignSpec& spec);

// Filled in, at most: the largest that is searched, or the experiment's; 0 where that is not known
// [kg].
double MostMass(const CampaignSpec& spec, const ExperimentSpec& experiment);

// Adds a problem for every quantity that cannot be, with the slip that is likely behind it.
void CheckPlausible(const CampaignSpec& spec, const std::vector<ExperimentSpec>& experiments,
                    base::Problems& problems);

}  // namespace talus::campaign
