#include "experiments/rigs/case/materials.h"

#include <cmath>

namespace talus::rigs {

engine::Material UsedMaterial(const Case& c) {
  engine::Material material = c.powder.material;
  material.surface_energy *=
      std::pow(c.coarse_graining.scale_factor, c.coarse_graining.surface_energy_exponent);
  return material;
}

std::vector<engine::Material> MaterialsOf(const Case& c) {
  const engine::Material powder = UsedMaterial(c);
  return {powder, c.materials.walls.value_or(WallMaterial()).Over(powder),
          c.materials.floor.value_or(WallMaterial()).Over(powder)};
}

}  // namespace talus::rigs
