// One step of the leapfrog (M3) for the particles of a panel, once all their forces are there.
#pragma once

#include "engine/kernel/simd.h"

namespace talus::engine::TALUS_TARGET {

struct Load6 {
  Vector<Lanes> force, torque;
};

TALUS_INLINE Load6 LoadForces(const double* rows, const std::int32_t* index) {
  const Quads f = LoadQuads(rows, 8, index);
  const Quads t = LoadQuads(rows + 4, 8, index);
  return {{f.x, f.y, f.z}, {t.x, t.y, t.z}};
}

TALUS_INLINE void ClearForces(double* rows) {
  const Lanes zero(0.0);
  for (int k = 0; k < 8 * Lanes::kWidth; k += Lanes::kWidth) zero.Store(rows + k);
}

TALUS_INLINE void StoreSingle(const StepView& step, std::int64_t at, const Quads& x, const Quads& v,
                              const Quads& w) {
  const Lanes speed(step.scales.motion_speed), spin(step.scales.motion_spin);
  StoreRounded({speed * v.x, speed * v.y, speed * v.z, Lanes(step.scales.inverse_mass) * v.w},
               {spin * w.x, spin * w.y, spin * w.z, Lanes(step.scales.inverse_inertia) * w.w},
               step.single + 8 * at);
  StoreSpots(x, step.scales.position, step.spot + 4 * at);
}

// The single rows and spots of all particles [begin, end), for motions that Integrate has not made.
void RoundMotion(const StepView& step, std::int64_t begin, std::int64_t end) {
  const std::int32_t index[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  for (std::int64_t at = begin; at < end; at += Lanes::kWidth) {
    StoreSingle(step, at, LoadQuads(step.motion + 8 * at, 8, index),
                LoadQuads(step.motion + 8 * at + 4, 8, index),
                LoadQuads(step.spin + 4 * at, 4, index));
  }
}

// Rows that no particle owns (1/m = 0) stay where they are.
TALUS_INLINE Lanes Advance(const StepView& step, std::int64_t at, const Load6& load,
                           const std::int32_t* index) {
  double* motion = step.motion + 8 * at;
  double* spin = step.spin + 4 * at;
  const Lanes dt(step.time_step);
  Quads x = LoadQuads(motion, 8, index);
  Quads v = LoadQuads(motion + 4, 8, index);
  Quads w = LoadQuads(spin, 4, index);
  const Lanes dt_if_real = Select(v.w > Lanes(0.0), dt, Lanes(0.0));
  const Lanes per_mass = Lanes(step.scales.force) * v.w;
  const Lanes turn = Lanes(step.scales.torque * step.time_step) * w.w;
  v.x = v.x + (load.force.x * per_mass + Lanes(step.gravity[0])) * dt_if_real;
  v.y = v.y + (load.force.y * per_mass + Lanes(step.gravity[1])) * dt_if_real;
  v.z = v.z + (load.force.z * per_mass + Lanes(step.gravity[2])) * dt_if_real;
  w.x = w.x + load.torque.x * turn;
  w.y = w.y + load.torque.y * turn;
  w.z = w.z + load.torque.z * turn;
  x.x = x.x + v.x * dt;
  x.y = x.y + v.y * dt;
  x.z = x.z + v.z * dt;
  StoreQuads(x, motion, 8);
  StoreQuads(v, motion + 4, 8);
  StoreQuads(w, spin, 4);
  StoreSingle(step, at, x, v, w);
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

MotionCheck Integrate(const StepView& view, const PanelView& panel, const Overhang* overhangs,
                      std::int64_t num_overhangs) {
  const StepView step = view;  // a copy, which no store can change
  const std::int32_t index[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const Lanes limit(step.speed_limit * step.speed_limit);
  Lanes fastest(0.0);
  unsigned sound = (1u << Lanes::kWidth) - 1u;
  for (std::int64_t at = panel.begin; at < panel.end; at += Lanes::kWidth) {
    double* rows = panel.forces + 8 * (at - panel.begin);
    Load6 load = LoadForces(rows, index);
    for (std::int64_t o = 0; o < num_overhangs; ++o) {
      const Overhang& over = overhangs[o];
      if (at >= over.end) continue;
      double* over_rows = over.forces + 8 * (at - over.begin);
      const Load6 more = LoadForces(over_rows, index);
      ClearForces(over_rows);
      load = {load.force + more.force, load.torque + more.torque};
    }
    ClearForces(rows);
    const Lanes speed_squared = Advance(step, at, load, index);
    fastest = Max(fastest, speed_squared);
    sound &= Bits(speed_squared <= limit);
  }
  double lanes[Lanes::kWidth] = {};
  fastest.Store(lanes);
  MotionCheck check{0, sound == (1u << Lanes::kWidth) - 1u};
  for (double lane : lanes)
    check.max_speed_squared = lane > check.max_speed_squared ? lane : check.max_speed_squared;
  return check;
}

}  // namespace talus::engine::TALUS_TARGET
