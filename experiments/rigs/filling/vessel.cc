#include "experiments/rigs/filling/vessel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/text/number_text.h"
#include "engine/overlap_check.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/time_step.h"
#include "experiments/rigs/filling/pouring.h"

namespace talus::rigs {
namespace {

// Adds grains that are numbered from `first_id` on.
engine::Filling FillDensely(const Case& c, const engine::FillRegion& region, std::int64_t first_id,
                            engine::Scene& scene) {
  const std::vector<double> radii = DrawRadii(c);
  const engine::FillRequest request{.region = region,
                                    .max_overlap = c.rules.fill_max_overlap,
                                    .max_sweeps = c.rules.fill_max_sweeps,
                                    .seed = c.seed};
  engine::Filling filling = engine::Fill(radii, request);
  if (filling.max_overlap > engine::kMaxOverlapAtStart) {
    throw base::ConfigError("rules.fill_max_sweeps: is " + std::to_string(request.max_sweeps) +
                            ", after which grains overlap by " +
                            base::ShortNumber(filling.max_overlap) +
                            " of a radius, above the 0.25 that holds; raise it");
  }
  for (std::size_t i = 0; i < radii.size(); ++i) {
    scene.particles.push_back({.id = first_id + static_cast<std::int64_t>(i),
                               .material = 0,
                               .radius = radii[i],
                               .position = filling.positions[i],
                               .velocity = {},
                               .angular_velocity = {}});
  }
  filling.positions.clear();
  return filling;
}

// Depth of a drum's bed under a flat surface [m]: a chord that is h deep in a circle of radius R
// cuts off (4/3) h √(2 R h), as long as h is much below R.
double DepthInDrum(const Case& c) {
  const double radius = c.rig.drum.diameter / 2;
  const double area = FillOf(c).value_or(0) * std::numbers::pi * radius * radius;
  return std::pow(0.75 * area / std::sqrt(2 * radius), 2.0 / 3);
}

}  // namespace

Vessel BoxVessel(const engine::Vec3& foot, double length, double width) {
  const engine::FillRegion region{
      .shape = engine::RegionShape::kBox, .base = foot, .width_x = length, .width_y = width};
  return {.region = region, .area = region.Area(), .across = std::min(length, width)};
}

std::int64_t FirstBedId(const Case& c, const Vessel& vessel) {
  if (!vessel.bed) return std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>(DrawRadii(c).size());
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
    made.filling = FillDensely(c, vessel.region, 0, scene);
  } else {
    // The step must suit the grains that are to come.
    const double smallest = engine::SizeCurve(c.powder.sizes).smallest() / 2;
    const double radius = c.coarse_graining.scale_factor * smallest;
    scene.time_step = StepFraction(c) * engine::RayleighTime(c.powder.material, radius);
  }
  if (vessel.bed) {
    Case bed = c;
    bed.powder.mass = vessel.bed->mass;
    FillDensely(bed, vessel.bed->region, FirstBedId(c, vessel), scene);
  }
  scene.materials = MaterialsOf(c);
  scene.pairs = PairsOf(c);
  scene.models = c.models;
  scene.gravity = {0, 0, -c.gravity};
  scene.rayleigh_fraction = StepFraction(c);
  scene.num_threads = c.threads;
  return made;
}

double FilledHeight(const Case& c, const Vessel& vessel) {
  constexpr double kSettled = 0.55;  // solid fraction of the filling
  return c.powder.mass / c.powder.material.density / (kSettled * vessel.area);
}

std::string ShallowWarning(const Case& c, const Vessel& vessel) {
  constexpr double kFewestDeep = 4;  // mean grains
  constexpr RigKind kDeep[] = {RigKind::kDrum, RigKind::kDrawDown, RigKind::kColumnCollapse,
                               RigKind::kOrificeFlow, RigKind::kTappedDensity};
  if (std::ranges::find(kDeep, c.rig.kind) == std::end(kDeep)) return "";
  const double height = c.rig.kind == RigKind::kDrum ? DepthInDrum(c) : FilledHeight(c, vessel);
  const double deep = height / EstimatePowder(c).mean_diameter;
  if (deep >= kFewestDeep) return "";
  return "the bed is only " + base::ShortNumber(deep, 2) + " grains deep: single grains decide; " +
         (c.coarse_graining.scale_factor > 1 ? "take a smaller scale factor, " : "") +
         "fill in more powder or take a smaller vessel";
}

}  // namespace talus::rigs
