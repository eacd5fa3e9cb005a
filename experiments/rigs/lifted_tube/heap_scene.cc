#include "experiments/rigs/lifted_tube/heap_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/scene/scene_warnings.h"
#include "experiments/rigs/lifted_tube/pouring.h"

namespace talus::rigs {
namespace {

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

void FillDensely(const HeapCase& c, HeapScene& made) {
  const std::vector<double> radii = DrawRadii(c);
  const engine::FillRequest request{.region = {.diameter = c.device.tube_inner_diameter},
                                    .max_overlap = c.rules.fill_max_overlap,
                                    .max_sweeps = c.rules.fill_max_sweeps,
                                    .seed = c.seed};
  made.filling = engine::Fill(radii, request);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    made.scene.particles.push_back({.id = static_cast<std::int64_t>(i),
                                    .material = 0,
                                    .radius = radii[i],
                                    .position = made.filling.positions[i],
                                    .velocity = {},
                                    .angular_velocity = {}});
  }
  made.filling.positions.clear();
}

}  // namespace

engine::Material UsedMaterial(const HeapCase& c) {
  engine::Material material = c.powder.material;
  material.surface_energy *=
      std::pow(c.coarse_graining.scale_factor, c.coarse_graining.surface_energy_exponent);
  return material;
}

double FilledVolume(const HeapCase& c, std::int64_t num_grains) {
  const std::vector<double> radii = DrawRadii(c);
  double cubes = 0;
  for (std::size_t i = 0; i < std::min(radii.size(), static_cast<std::size_t>(num_grains)); ++i) {
    cubes += radii[i] * radii[i] * radii[i];
  }
  return 4.0 / 3 * std::numbers::pi * cubes;
}

HeapScene MakeHeapScene(const HeapCase& c) {
  HeapScene made;
  engine::Scene& scene = made.scene;
  double tube_length = PouredTubeLength(c);
  if (c.filling.kind == FillingKind::kDense) {
    FillDensely(c, made);
    tube_length = 1.1 * made.filling.height;
  } else {
    // The step must suit the grains that are to come.
    const double smallest = engine::SizeCurve(c.powder.sizes).smallest() / 2;
    const double radius = c.coarse_graining.scale_factor * smallest;
    scene.time_step = c.rayleigh_fraction * engine::RayleighTime(c.powder.material, radius);
  }
  scene.materials = Materials(c);
  scene.models = c.models;
  scene.walls = Walls(c, tube_length);
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
  for (std::string& warning : engine::AdhesionWarnings(c.models, Materials(c))) {
    warnings.push_back(std::move(warning));
  }
  if (c.models.rolling == engine::Rolling::kConstant && c.rayleigh_fraction > 0.15) {
    warnings.push_back(
        "constant rolling resistance creeps in proportion to the time step: set rayleigh_fraction "
        "to 0.15 or less");
  }
  return warnings;
}

}  // namespace talus::rigs
