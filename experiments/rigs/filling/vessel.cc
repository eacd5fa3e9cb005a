#include "experiments/rigs/filling/vessel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/filling/pouring.h"

namespace talus::rigs {
namespace {

void FillDensely(const Case& c, const engine::FillRegion& region, FilledScene& made) {
  const std::vector<double> radii = DrawRadii(c);
  const engine::FillRequest request{.region = region,
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

Vessel BoxVessel(const engine::Vec3& foot, double length, double width) {
  const engine::FillRegion region{
      .shape = engine::RegionShape::kBox, .base = foot, .width_x = length, .width_y = width};
  return {.region = region, .area = region.Area(), .across = std::min(length, width)};
}

double FilledVolume(const Case& c, std::int64_t num_grains) {
  const std::vector<double> radii = DrawRadii(c);
  double cubes = 0;
  for (std::size_t i = 0; i < std::min(radii.size(), static_cast<std::size_t>(num_grains)); ++i) {
    cubes += radii[i] * radii[i] * radii[i];
  }
  return 4.0 / 3 * std::numbers::pi * cubes;
}

FilledScene FillVessel(const Case& c, const Vessel& vessel) {
  FilledScene made;
  engine::Scene& scene = made.scene;
  if (c.filling.kind == FillingKind::kDense) {
    FillDensely(c, vessel.region, made);
  } else {
    // The step must suit the grains that are to come.
    const double smallest = engine::SizeCurve(c.powder.sizes).smallest() / 2;
    const double radius = c.coarse_graining.scale_factor * smallest;
    scene.time_step = c.rayleigh_fraction * engine::RayleighTime(c.powder.material, radius);
  }
  scene.materials = MaterialsOf(c);
  scene.pairs = PairsOf(c);
  scene.models = c.models;
  scene.gravity = {0, 0, -c.gravity};
  scene.rayleigh_fraction = c.rayleigh_fraction;
  scene.num_threads = c.threads;
  return made;
}

double FilledHeight(const Case& c, const Vessel& vessel) {
  constexpr double kSettled = 0.55;  // solid fraction of the filling
  return c.powder.mass / c.powder.material.density / (kSettled * vessel.area);
}

}  // namespace talus::rigs
