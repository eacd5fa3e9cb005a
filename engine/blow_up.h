// What no sound run does, and how it is reported.
#pragma once

#include <string>

#include "engine/simulation_state.h"

namespace talus::engine {

// The fastest that anything in the scene can get from its own start, from adhesion, from the
// overlaps that there are, and from the walls [m/s]. Ten times this and the free fall so far is the
// limit.
double ReferenceSpeed(SimulationState& state);
double SpeedLimit(const SimulationState& state);

// "step 17 (t = 3e-05 s): "
std::string StepText(const SimulationState& state);

// Names the particle that is too fast or not a number.
[[noreturn]] void ThrowBlowUp(const SimulationState& state);

}  // namespace talus::engine
