#include "experiments/rigs/case/case.h"

#include <algorithm>
#include <cmath>

#include "engine/scene.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/plausible_quantity.h"
#include "experiments/rigs/case/time_step.h"
#include "imaging/heap/film_strip.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {

void Powder::Validate(base::Problems& problems) const {
  problems.Require(mass >= 0 && std::isfinite(mass), "mass", mass, "must be positive");
}

void CoarseGraining::Validate(base::Problems& problems) const {
  problems.Require(scale_factor >= 1 && std::isfinite(scale_factor), "scale_factor", scale_factor,
                   "must be 1 or more");
  problems.Require(surface_energy_exponent >= 0 && surface_energy_exponent <= 3,
                   "surface_energy_exponent", surface_energy_exponent, "must be in [0, 3]");
}

void CaseOutputs::Validate(base::Problems& problems) const {
  for (std::size_t i = 0; i < times.size(); ++i) {
    problems.Require(times[i] >= 0 && (i == 0 || times[i] > times[i - 1]),
                     "times[" + std::to_string(i) + "]", times[i],
                     "must not be negative, and above the one before");
  }
}

void Case::Validate(base::Problems& problems) const {
  ValidatePairs(pairs, problems);
  RequirePlausibleGrains(powder, problems);
  if (rig.kind == RigKind::kLiftedTube) {
    RequirePlausibleTube(rig.lifted_tube, "device", problems);
  } else {
    RequirePlausibleRig(rig, "rig", problems);
  }
  RequireNoTube(rig.kind, rig.lifted_tube, "device", problems);
  const bool has_fill = rig.kind == RigKind::kDrum && rig.drum.fill;
  problems.Require(powder.mass != 0 || has_fill, "powder.mass",
                   "is missing or 0, must be positive (a drum may have rig.fill instead)");
  problems.Require(powder.mass == 0 || !has_fill, "rig.fill",
                   "stands beside powder.mass: give one of the two");
  problems.RequirePositive("gravity", gravity);
  problems.Require(rayleigh_fraction > 0 && rayleigh_fraction <= 0.4, "rayleigh_fraction",
                   rayleigh_fraction, "must be in (0, 0.4]");
  problems.Require(!frame || !frame->pictures, "frame.pictures",
                   "is not of a case: remove it, and state rig.camera.times");
  problems.RequireFromTo("num_views", num_views, 1, imaging::kMostViews);
  problems.Require(threads >= 1, "threads", threads, "must be at least 1");
  problems.Require(checkpoint_interval >= 0 && std::isfinite(checkpoint_interval),
                   "checkpoint_interval", checkpoint_interval, "must not be negative");
}

Device Case::DeviceKey() const {
  Device device;
  static_cast<LiftedTubeOptions&>(device) = rig.lifted_tube;
  device.tube_material = materials.walls;
  device.plate_material = materials.floor;
  return device;
}

void Case::SetDevice(const Device& device) {
  rig.lifted_tube = device;
  materials = {.walls = device.tube_material, .floor = device.plate_material};
}

void Case::SetMassByFill() {
  if (rig.kind != RigKind::kDrum || !rig.drum.fill) return;
  powder.mass = rig.drum.GrainVolume() * powder.material.density;
  rig.drum.fill.reset();
}

std::optional<double> FillOf(const Case& c) {
  if (c.rig.kind != RigKind::kDrum) return std::nullopt;
  DrumOptions full = c.rig.drum;
  full.fill = 1;
  return c.powder.mass / (full.GrainVolume() * c.powder.material.density);
}

imaging::Frame ProfileFrameOf(const Case& c) {
  return imaging::StripOf(c.frame.value(), c.rig.camera ? c.rig.camera->num_pictures() : 1);
}

PowderSize EstimatePowder(const Case& c) {
  const engine::SizeCurve curve(c.powder.sizes);
  const double f = c.coarse_graining.scale_factor;
  const double volume = c.powder.mass / c.powder.material.density;
  PowderSize size;
  size.grains = volume / (f * f * f * curve.mean_volume());
  size.num_grains = std::llround(std::min(size.grains, 1e18));
  size.mean_diameter = f * curve.VolumeQuantile(0.5);
  size.time_step =
      StepFraction(c) * engine::RayleighTime(c.powder.material, f * curve.smallest() / 2);
  return size;
}

double LargestDiameter(const Case& c) {
  return c.coarse_graining.scale_factor * engine::SizeCurve(c.powder.sizes).largest();
}

double SpreadingGap(const Case& c) {
  return c.rig.spreading.gap.value_or(3 * engine::SizeCurve(c.powder.sizes).VolumeQuantile(0.9));
}

}  // namespace talus::rigs
