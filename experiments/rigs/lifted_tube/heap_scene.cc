#include "experiments/rigs/lifted_tube/heap_scene.h"

#include <cmath>
#include <sstream>

namespace talus::experiments {
namespace {

std::vector<double> DrawRadii(const HeapCase& c) {
  const double f = c.coarse_graining.scale_factor;
  const double volume = c.powder.mass / c.powder.material.density;
  std::vector<double> radii =
      engine::DrawDiameters(engine::SizeCurve(c.powder.sizes), volume / (f * f * f));
  for (double& r : radii) r *= f / 2;
  return engine::Shuffled(std::move(radii), c.seed);
}

std::vector<engine::Material> Materials(const HeapCase& c) {
  const engine::Material powder = UsedMaterial(c);
  return {powder, c.device.tube_material.value_or(WallMaterial()).Over(powder),
          c.device.plate_material.value_or(WallMaterial()).Over(powder)};
}

std::vector<engine::Wall> Walls(const HeapCase& c, double default_tube_length) {
  const double plate_radius = c.device.plate_diameter / 2;
  engine::WallShape plate = engine::Disc{.center = {}, .radius = plate_radius};
  if (c.device.plate == PlateKind::kSolidCylinder) {
    plate = engine::SolidCylinder{.base = {0, 0, -c.device.plate_height},
                                  .radius = plate_radius,
                                  .length = c.device.plate_height};
  }
  const engine::OpenCylinder tube{.base = {},
                                  .radius = c.device.tube_inner_diameter / 2,
                                  .length = c.device.tube_length.value_or(default_tube_length)};
  return {{.name = "tube", .shape = tube, .material = 1, .motion = {}},
          {.name = "plate", .shape = plate, .material = 2, .motion = {}}};
}

}  // namespace

engine::Material UsedMaterial(const HeapCase& c) {
  engine::Material material = c.powder.material;
  material.surface_energy *=
      std::pow(c.coarse_graining.scale_factor, c.coarse_graining.surface_energy_exponent);
  return material;
}

HeapScene MakeHeapScene(const HeapCase& c) {
  const std::vector<double> radii = DrawRadii(c);
  const engine::FillRequest request{.region = {.diameter = c.device.tube_inner_diameter},
                                    .max_overlap = c.rules.fill_max_overlap,
                                    .max_sweeps = c.rules.fill_max_sweeps,
                                    .seed = c.seed};
  HeapScene made{.scene = {}, .filling = engine::Fill(radii, request)};
  engine::Scene& scene = made.scene;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    scene.particles.push_back({.id = static_cast<std::int64_t>(i),
                               .material = 0,
                               .radius = radii[i],
                               .position = made.filling.positions[i],
                               .velocity = {},
                               .angular_velocity = {}});
  }
  made.filling.positions.clear();
  scene.materials = Materials(c);
  scene.models = c.models;
  scene.walls = Walls(c, 1.1 * made.filling.height);
  scene.gravity = {0, 0, -c.gravity};
  scene.rayleigh_fraction = c.rayleigh_fraction;
  scene.num_threads = c.threads;
  return made;
}

std::vector<std::string> HeapWarnings(const HeapCase& c) {
  std::vector<std::string> warnings;
  const double across = c.device.plate_diameter / EstimateHeap(c).mean_diameter;
  std::ostringstream text;
  text.precision(3);
  if (across < 15) {
    text << "COARSE: only " << across
         << " grains across the plate: the heap is a pile of boulders, and its shape says little "
            "of the powder; lower the scale factor (30 or more are advised)";
  } else if (across < 30) {
    text << "only " << across << " grains across the plate; 30 or more are advised";
  }
  if (across < 30) warnings.push_back(text.str());
  if (c.rayleigh_fraction > kHeapRayleighFraction) {
    warnings.push_back("rayleigh_fraction is above 0.3: heaps have been compared up to there only");
  }
  if (c.models.rolling == engine::Rolling::kConstant && c.rayleigh_fraction > 0.15) {
    warnings.push_back(
        "constant rolling resistance creeps in proportion to the time step: set rayleigh_fraction "
        "to 0.15 or less");
  }
  return warnings;
}

}  // namespace talus::experiments
