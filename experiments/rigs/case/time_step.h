// The time step of a case.
#pragma once

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Δt / t_R of the smallest grain [-]: `rayleigh_fraction`, or less where the rolling resistance
// between grains does not bear that much (docs/physics.md, M6).
double StepFraction(const Case& rig_case);

// What makes it less: the rolling spring, or the dashpot.
bool IsSpringLimited(const Case& rig_case);

}  // namespace talus::rigs
