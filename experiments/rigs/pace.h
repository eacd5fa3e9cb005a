// How often a test looks at its phase's criterion, and how far it advances at a time.
#pragma once

#include <cstdint>

#include "engine/simulation.h"
#include "experiments/rigs/lifted_tube/heap_case.h"

namespace talus::rigs {

// Steps between two looks: grains fall an eighth of a diameter meanwhile.
std::int64_t CheckSteps(const HeapCase& heap_case, double time_step);

// Steps to the next look, the slice's end or the first step at or after `until` [s], whichever is
// first.
std::int64_t StepsOfSlice(const engine::Simulation& simulation, std::int64_t check_steps,
                          double until);

}  // namespace talus::rigs
