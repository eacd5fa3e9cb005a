// What a heap test knows beside the engine's state: the phase it is in and how the earlier ones
// ended. It is part of the checkpoint and of the result.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/field.h"
#include "engine/run/bed.h"
#include "engine/scene/pour.h"
#include "experiments/rigs/phase.h"

namespace talus::rigs {

enum class HeapPhase { kPouring, kSettling, kTapping, kLifting, kResting, kEnded };

struct HeapState {
  HeapPhase phase = HeapPhase::kSettling;
  PhaseRecord pouring;
  PhaseRecord settling;  // after the taps, if there were any
  PhaseRecord tapping;
  PhaseRecord lifting;
  PhaseRecord heap;
  engine::PourState pour;
  engine::Bed bed;           // when the tube was lifted
  double filled_height = 0;  // [m]
  double fill_overlap = 0;   // largest overlap / radius [-]
  int fill_sweeps = 0;
  std::int64_t num_filled = 0;
  std::int64_t num_fallen = 0;        // left over the plate's rim
  std::int64_t num_carried = 0;       // taken away by the tube
  std::int64_t num_quiet_checks = 0;  // in a row, for which the phase's criterion has held
  double particle_steps = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("phase", self.phase);
    visit("pouring", self.pouring);
    visit("settling", self.settling);
    visit("tapping", self.tapping);
    visit("lifting", self.lifting);
    visit("heap", self.heap);
    visit("pour", self.pour);
    visit("bed_height_m", self.bed.height);
    visit("solid_fraction", self.bed.solid_fraction);
    visit("coordination", self.bed.coordination);
    visit("filled_height_m", self.filled_height);
    visit("fill_overlap", self.fill_overlap);
    visit("fill_sweeps", self.fill_sweeps);
    visit("num_filled", self.num_filled);
    visit("num_fallen", self.num_fallen);
    visit("num_carried", self.num_carried);
    visit("num_quiet_checks", self.num_quiet_checks);
    visit("particle_steps", self.particle_steps);
  }
};

}  // namespace talus::rigs

template <>
struct talus::base::Names<talus::rigs::HeapPhase> {
  using P = talus::rigs::HeapPhase;
  static constexpr std::array kList{
      std::pair{"pouring", P::kPouring},        std::pair{"settling", P::kSettling},
      std::pair{"tapping", P::kTapping},        std::pair{"lifting", P::kLifting},
      std::pair{"coming to rest", P::kResting}, std::pair{"ended", P::kEnded}};
};
