// The time step of a case.
#pragma once

#include "engine/laws/longest_step.h"
#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Δt / t_R of the smallest grain [-]: `rayleigh_fraction`, or less where the contacts between
// grains do not bear that much (docs/physics.md, M6 and M7).
double StepFraction(const Case& rig_case);

// What allows no longer step.
engine::StepBound BoundOf(const Case& rig_case);

}  // namespace talus::rigs
