// What every rig knows beside the engine's state: part of the checkpoint and of the result.
#pragma once

#include <cstdint>
#include <vector>

#include "base/field.h"
#include "engine/run/bed.h"
#include "engine/scene/pour.h"
#include "experiments/rigs/phased/camera.h"
#include "experiments/rigs/phased/phase.h"
#include "experiments/rigs/phased/regime.h"

namespace talus::rigs {

struct RigState {
  std::uint64_t phase = 0;            // which; the number of phases when it has ended
  std::vector<PhaseRecord> phases{};  // one each
  engine::PourState pour;
  double fill_overlap = 0;   // largest overlap / radius of the dense filling [-]
  double filled_height = 0;  // of the dense filling before it settles [m]
  int fill_sweeps = 0;
  std::int64_t num_filled = 0;
  std::int64_t num_quiet_checks = 0;  // in a row, for which the phase's criterion has held
  double particle_steps = 0;
  engine::Bed bed{};  // when the filling had settled
  CameraMemory camera{};
  RegimeMemory regime{};  // of the rig's own phases

  static constexpr base::FieldKey kKeys[] = {{"filled_height", "filled_height_m"},
                                             {"bed.height", "bed_height_m"},
                                             {"bed.solid_fraction", "solid_fraction"},
                                             {"bed.coordination", "coordination"}};
  TALUS_FIELDS(phase, phases, pour, fill_overlap, filled_height, fill_sweeps, num_filled,
               num_quiet_checks, particle_steps, bed.height, bed.solid_fraction, bed.coordination,
               camera, regime);
};

}  // namespace talus::rigs
