// How often a test looks at its phase's criterion, and how far it advances at a time.
#pragma once

#include <cstdint>

#include "engine/scene/pour.h"
#include "engine/simulation.h"
#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Steps between two looks: grains fall an eighth of a diameter meanwhile.
std::int64_t CheckSteps(const Case& rig_case, double time_step);

struct SliceEnd {
  std::int64_t check_steps = 1;
  double until = 0;  // [s]
  // Where powder is poured: the grains that are due are put in first, and the slice ends when the
  // next are.
  const engine::Pour* pour = nullptr;
  engine::PourState* pour_state = nullptr;
};

struct Slice {
  std::int64_t steps = 0;
  double particle_steps = 0;  // grains times steps
};

// Advances to the next look, the slice's end or the first step at or after `until`, whichever is
// first.
Slice AdvanceSlice(engine::Simulation& simulation, const SliceEnd& end);

// What filling usually takes to come to rest, and most tests [s].
double SettlingTime(const Case& rig_case);
inline constexpr double kRestTime = 0.17;

// The whole of a test that takes so long beside pouring and settling [s].
double SimulatedTime(const Case& rig_case, double test_time);

}  // namespace talus::rigs
