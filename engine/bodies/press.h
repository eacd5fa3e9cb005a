// Walls that move together along one direction, pressed by a force: a lid on a powder.
//
//   m dw/dt = F + f·n − c w                                              docs/physics.md, M5
//
// w is their speed along n beside what their motion prescribes, f the force of the spheres on all
// of them. F is the whole load: gravity adds nothing, a lid's weight is part of F. The speed lives
// half a step behind the place, as the spheres' do (M3); the damping takes the mean of two speeds,
// which is stable for every c.
#pragma once

#include <vector>

#include "base/problems.h"
#include "base/vec3.h"

namespace talus::engine {

using base::Vec3;

struct Press {
  std::vector<int> walls{};  // indices, one at least
  Vec3 direction{0, 0, -1};  // n, unit vector
  double force = 0;          // F [N], >= 0
  double mass = 0;           // m [kg], > 0
  double damping = 0;        // c [kg/s], > 0: without it a lid rings
  double speed = 0;          // w [m/s]
};

void ValidatePress(const Press& press, int num_walls, base::Problems& problems);

// The speed a step later under `load`, f·n [N].
double PushedSpeed(const Press& press, double load, double time_step);

// At which it moves where nothing holds it [m/s].
inline double FreeSpeed(const Press& press) { return press.force / press.damping; }

}  // namespace talus::engine
