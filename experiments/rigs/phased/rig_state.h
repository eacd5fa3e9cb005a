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

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("phase", self.phase);
    visit("phases", self.phases);
    visit("pour", self.pour);
    visit("fill_overlap", self.fill_overlap);
    visit("filled_height_m", self.filled_height);
    visit("fill_sweeps", self.fill_sweeps);
    visit("num_filled", self.num_filled);
    visit("num_quiet_checks", self.num_quiet_checks);
    visit("particle_steps", self.particle_steps);
    visit("bed_height_m", self.bed.height);
    visit("solid_fraction", self.bed.solid_fraction);
    visit("coordination", self.bed.coordination);
    visit("camera", self.camera);
    visit("regime", self.regime);
  }
};

}  // namespace talus::rigs
