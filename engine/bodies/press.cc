#include "engine/bodies/press.h"

#include <algorithm>
#include <cmath>

namespace talus::engine {

void ValidatePress(const Press& press, int num_walls, base::Problems& problems) {
  const auto known = [&](int wall) { return wall >= 0 && wall < num_walls; };
  problems.Require(!press.walls.empty() && std::ranges::all_of(press.walls, known), "walls",
                   "must name walls of the scene, one at least");
  problems.Require(std::abs(base::Norm(press.direction) - 1) < 1e-9, "direction",
                   "must be a unit vector");
  problems.Require(press.force >= 0 && std::isfinite(press.force), "force", press.force,
                   "must not be negative");
  problems.RequirePositive("mass", press.mass);
  problems.RequirePositive("damping", press.damping);
  problems.Require(std::isfinite(press.speed), "speed", press.speed, "must be finite");
}

double PushedSpeed(const Press& press, double load, double time_step) {
  const double half = press.damping * time_step / (2 * press.mass);
  const double gained = (press.force + load) * time_step / press.mass;
  return ((1 - half) * press.speed + gained) / (1 + half);
}

}  // namespace talus::engine
