#include "experiments/rigs/lifted_tube/heap_case.h"

#include <algorithm>
#include <cmath>

#include "base/text/number_text.h"
#include "engine/scene/filling.h"
#include "engine/scene/scene.h"
#include "experiments/rigs/lifted_tube/pouring.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {
namespace {

constexpr double kLargestPlate = 2;  // [m]

void RequirePositive(base::Problems& problems, const char* key, double value) {
  problems.Require(value > 0 && std::isfinite(value), key, value, "must be positive");
}

}  // namespace

void Powder::Validate(base::Problems& problems) const { RequirePositive(problems, "mass", mass); }

void CoarseGraining::Validate(base::Problems& problems) const {
  problems.Require(scale_factor >= 1 && std::isfinite(scale_factor), "scale_factor", scale_factor,
                   "must be 1 or more");
  problems.Require(surface_energy_exponent >= 0 && surface_energy_exponent <= 3,
                   "surface_energy_exponent", surface_energy_exponent, "must be in [0, 3]");
}

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

void Device::Validate(base::Problems& problems) const {
  RequirePositive(problems, "tube_inner_diameter", tube_inner_diameter);
  RequirePositive(problems, "plate_diameter", plate_diameter);
  problems.Require(!(plate_diameter > kLargestPlate), "plate_diameter", plate_diameter,
                   "must be at most 2 m; write \"10 mm\" for 10 mm");
  RequirePositive(problems, "plate_height", plate_height);
  RequirePositive(problems, "lift_velocity", lift_velocity);
  if (tube_length) RequirePositive(problems, "tube_length", *tube_length);
  problems.Require(!(tube_inner_diameter > plate_diameter), "tube_inner_diameter",
                   tube_inner_diameter, "must not be above plate_diameter: the tube stands on it");
}

void RestRule::Validate(base::Problems& problems) const {
  RequirePositive(problems, "energy_fraction", energy_fraction);
  problems.Require(moving_share >= 0 && moving_share < 1, "moving_share", moving_share,
                   "must be in [0, 1)");
  RequirePositive(problems, "hold_time", hold_time);
  RequirePositive(problems, "max_time", max_time);
  problems.Require(!(hold_time > max_time), "hold_time", hold_time, "must not exceed max_time");
}

void TapRule::Validate(base::Problems& problems) const {
  RequirePositive(problems, "count", count);
  RequirePositive(problems, "height", height);
  problems.Require(interval > 3 * std::sqrt(2 * height / 9.81), "interval", interval,
                   "must be above three times the time of the fall");
}

void FillingRule::Validate(base::Problems& problems) const {
  const auto check = [&](const char* key, const std::optional<double>& value) {
    if (!value) return;
    problems.Require(kind == FillingKind::kPour, key, "belongs to the kind pour; remove it");
    if (std::string_view(key) == "scatter") {
      problems.Require(*value >= 0 && std::isfinite(*value), key, *value, "must not be negative");
    } else {
      RequirePositive(problems, key, *value);
    }
  };
  check("drop_height", drop_height);
  check("mouth_diameter", mouth_diameter);
  check("rate", rate);
  check("scatter", scatter);
}

void HeapRules::Validate(base::Problems& problems) const {
  RequirePositive(problems, "fill_max_overlap", fill_max_overlap);
  RequirePositive(problems, "fill_max_sweeps", fill_max_sweeps);
  RequirePositive(problems, "leave_depth", leave_depth);
  if (lift_max_time) RequirePositive(problems, "lift_max_time", *lift_max_time);
}

void HeapOutputs::Validate(base::Problems& problems) const {
  for (std::size_t i = 0; i < times.size(); ++i) {
    problems.Require(times[i] >= 0 && (i == 0 || times[i] > times[i - 1]),
                     "times[" + std::to_string(i) + "]", times[i],
                     "must not be negative, and above the one before");
  }
}

namespace {

// A grain that sinks too deeply into what it falls on would be pressed through the floor.
void ValidatePour(const HeapCase& c, const Vessel& vessel, base::Problems& problems) {
  const double largest =
      c.coarse_graining.scale_factor * engine::SizeCurve(c.powder.sizes).largest();
  const double mouth = MouthDiameter(c, vessel);
  problems.Require(mouth < vessel.across, "filling.mouth_diameter", mouth,
                   KindOf(c) == RigKind::kLiftedTube ? "must be below device.tube_inner_diameter"
                                                     : "must be below the width of the vessel");
  problems.Require(!c.filling.mouth_diameter || mouth > 2 * largest, "filling.mouth_diameter",
                   mouth, "must be above two (scaled) grain diameters");
  if (!problems.empty()) return;
  const double share = ImpactShare(c, vessel);
  if (share <= kMaxImpactShare) return;
  // (δ/R)^(5/2) goes with v²/E, and v² nearly with the height.
  const double ratio = std::pow(share / kMaxImpactShare, 2.5);
  problems.Add("filling.drop_height",
               "lets grains sink " + base::ShortNumber(share) +
                   " of their radius into each other or into a wall, above the " +
                   base::ShortNumber(kMaxImpactShare) + " that holds; raise youngs_modulus " +
                   base::ShortNumber(ratio) + " times, lower drop_height, or fill with kind dense");
}

}  // namespace

void HeapCase::Validate(base::Problems& problems) const {
  RequirePositive(problems, "gravity", gravity);
  problems.Require(rayleigh_fraction > 0 && rayleigh_fraction <= 0.4, "rayleigh_fraction",
                   rayleigh_fraction, "must be in (0, 0.4]");
  problems.Require(num_views >= 1 && num_views <= imaging::kMostViews, "num_views", num_views,
                   "must be from 1 to 1000");
  problems.Require(threads >= 1, "threads", threads, "must be at least 1");
  problems.Require(checkpoint_interval >= 0 && std::isfinite(checkpoint_interval),
                   "checkpoint_interval", checkpoint_interval, "must not be negative");
  if (!problems.empty() || powder.sizes.kind == engine::SizeKind::kFile) return;
  const HeapSize size = EstimateHeap(*this);
  const double largest = coarse_graining.scale_factor * engine::SizeCurve(powder.sizes).largest();
  const std::string too_many = engine::TooManyGrains(size.grains);
  problems.Require(too_many.empty(), "powder.mass", too_many);
  problems.Require(size.num_grains >= 1, "powder.mass", powder.mass,
                   "is less than one grain; the coarse graining may be too strong");
  const RigEntry& entry = EntryOf(*this);
  const Vessel vessel = entry.vessel(*this);
  problems.Require(3 * largest < vessel.across, rig ? "rig" : "device.tube_inner_diameter",
                   vessel.across, "must be above three (scaled) grain diameters");
  entry.validate(*this, problems);
  if (problems.empty() && filling.kind == FillingKind::kPour) {
    ValidatePour(*this, vessel, problems);
  }
}

HeapSize EstimateHeap(const HeapCase& c) {
  constexpr double kSettled = 0.55;  // solid fraction of the filling
  const engine::SizeCurve curve(c.powder.sizes);
  const double f = c.coarse_graining.scale_factor;
  const double volume = c.powder.mass / c.powder.material.density;
  const RigEntry& entry = EntryOf(c);
  HeapSize size;
  size.grains = volume / (f * f * f * curve.mean_volume());
  size.num_grains = std::llround(std::min(size.grains, 1e18));
  size.mean_diameter = f * curve.VolumeQuantile(0.5);
  size.time_step =
      c.rayleigh_fraction * engine::RayleighTime(c.powder.material, f * curve.smallest() / 2);
  size.filled_height = volume / (kSettled * entry.vessel(c).area);
  constexpr double kStill = 0.1;  // settling and coming to rest, as seen in runs [s]
  size.simulated_time = kStill + entry.test_time(c, size.filled_height);
  if (c.filling.taps) size.simulated_time += c.filling.taps->count * c.filling.taps->interval;
  return size;
}

}  // namespace talus::rigs
