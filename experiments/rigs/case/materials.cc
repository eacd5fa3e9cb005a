#include "experiments/rigs/case/materials.h"

#include <cmath>

namespace talus::rigs {
namespace {

engine::Material Scaled(engine::Material material, const Case& c) {
  material.surface_energy *= SurfaceEnergyFactor(c);
  return material;
}

}  // namespace

double SurfaceEnergyFactor(const Case& c) {
  return std::pow(c.coarse_graining.scale_factor, c.coarse_graining.surface_energy_exponent);
}

engine::Material UsedMaterial(const Case& c) { return Scaled(c.powder.material, c); }

std::vector<engine::Material> MaterialsOf(const Case& c) {
  const auto wall = [&](const std::optional<WallMaterial>& stated) {
    return Scaled(stated.value_or(WallMaterial()).Over(c.powder.material), c);
  };
  return {UsedMaterial(c), wall(c.materials.walls), wall(c.materials.floor)};
}

}  // namespace talus::rigs
