#include "experiments/rigs/options/wall_material.h"

namespace talus::rigs {

engine::Material WallMaterial::Over(const engine::Material& powder) const {
  engine::Material wall = powder;
  wall.youngs_modulus = youngs_modulus.value_or(wall.youngs_modulus);
  wall.poisson_ratio = poisson_ratio.value_or(wall.poisson_ratio);
  wall.restitution = restitution.value_or(wall.restitution);
  wall.sliding_friction = sliding_friction.value_or(wall.sliding_friction);
  wall.rolling_friction = rolling_friction.value_or(wall.rolling_friction);
  wall.rolling_damping = rolling_damping.value_or(wall.rolling_damping);
  wall.surface_energy = surface_energy.value_or(wall.surface_energy);
  wall.hamaker_constant = hamaker_constant.value_or(wall.hamaker_constant);
  return wall;
}

void WallMaterial::Validate(base::Problems& problems) const { Over({}).Validate(problems); }

}  // namespace talus::rigs
