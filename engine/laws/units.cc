#include "engine/laws/units.h"

#include <algorithm>
#include <cmath>

namespace talus::engine {

namespace {

double PowerOfTwo(double value) { return std::exp2(std::round(std::log2(value))); }

}  // namespace

Units UnitsOf(std::span<const Material> materials, double time_step) {
  const auto square_of_speed = [](const Material& m) { return m.youngs_modulus / m.density; };
  const Material& slowest = *std::ranges::min_element(materials, {}, square_of_speed);
  const double length = PowerOfTwo(time_step * std::sqrt(square_of_speed(slowest)));
  return {.length = length,
          .mass = PowerOfTwo(slowest.density * length * length * length),
          .time = PowerOfTwo(time_step)};
}

SingleConstants ToUnits(const PairConstants& pair, const Units& units) {
  const auto in = [](double value, double unit) { return static_cast<float>(value / unit); };
  const double stress = units.Stress();
  return {.y_star = in(pair.y_star, stress),
          .normal_stiffness = in(pair.normal_stiffness, stress),
          .shear_stiffness = in(pair.shear_stiffness, stress),
          .shear_compliance = in(pair.shear_compliance, 1 / stress),
          .normal_damping = in(pair.normal_damping, std::sqrt(stress)),
          .tangential_damping = in(pair.tangential_damping, std::sqrt(stress)),
          .sliding_friction = in(pair.sliding_friction, 1),
          .rolling_friction = in(pair.rolling_friction, 1),
          .rolling_per_speed = in(pair.rolling_per_speed, 1 / units.Speed()),
          .rolling_stiffness = in(pair.rolling_stiffness, stress),
          .rolling_damping = in(pair.rolling_damping, std::sqrt(stress)),
          .mobilised_damping = in(pair.mobilised_damping, 1),
          .surface_energy = in(pair.surface_energy, units.SurfaceEnergy()),
          .pull_off = in(pair.pull_off, units.SurfaceEnergy()),
          .jkr_cube_root = in(pair.jkr_cube_root, std::cbrt(units.length)),
          .rolling_pull_off = in(pair.rolling_pull_off, units.SurfaceEnergy()),
          .keeps_spring = pair.keeps_spring,
          .hamaker = in(pair.hamaker, units.Torque()),
          .plateau_gap = in(pair.plateau_gap, units.length),
          .adhesion_gap = in(pair.adhesion_gap, units.length)};
}

}  // namespace talus::engine
