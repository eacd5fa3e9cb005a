#include "experiments/rigs/filling/pouring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/laws/pair_constants.h"
#include "experiments/rigs/case/materials.h"

namespace talus::rigs {
namespace {

constexpr double kFollowed = 0.5;  // solid fraction that the mouth rises with
// The mouth's diameter over the vessel's [-]. Half of it takes longer than the lifting, and out of
// 0.7 of it the stream drives soft grains through the plate (docs/validation.md, Filling).
constexpr double kMouth = 0.6;

// The diameter of a mouth out of which grains up to this diameter are poured.
double MouthFor(double largest, const Case& c, const Vessel& vessel) {
  if (vessel.funnel) return vessel.funnel->outlet;
  // Not so narrow that grains come down in a file.
  const double least = std::min(4 * largest, 0.9 * vessel.across);
  return c.filling.mouth_diameter.value_or(std::max(kMouth * vessel.across, least));
}

// What true grains run out with: coarse ones may need a wider mouth, and no other rate.
double UsualRate(engine::PourPlan plan, const Case& c, const Vessel& vessel) {
  const double f = c.coarse_graining.scale_factor;
  plan.mouth_diameter = MouthFor(LargestDiameter(c) / f, c, vessel);
  return engine::BeverlooRate(plan, f);
}

}  // namespace

std::vector<double> DrawRadii(const Case& c) {
  const double f = c.coarse_graining.scale_factor;
  const double volume = c.powder.mass / c.powder.material.density;
  std::vector<double> radii =
      engine::DrawDiameters(engine::SizeCurve(c.powder.sizes), volume / (f * f * f));
  for (double& r : radii) r *= f / 2;
  return engine::Shuffled(std::move(radii), c.seed);
}

double PouredHeight(const Case& c, const Vessel& vessel) {
  return c.powder.mass / c.powder.material.density / (kLooseSolidFraction * vessel.area);
}

double DropHeight(const Case& c, const Vessel& vessel) {
  if (vessel.funnel) return vessel.funnel->height;
  return c.filling.drop_height.value_or(vessel.across / 2);
}

double Headroom(const Case& c, const Vessel& vessel, const std::optional<TapRule>& taps) {
  constexpr double kStrokes = 4;  // a grain on top is thrown higher than its floor
  const double thrown = taps ? kStrokes * taps->height : 0;
  if (c.filling.kind != FillingKind::kPour) return thrown;
  return DropHeight(c, vessel) + MakePour(c, vessel).slab() + LargestDiameter(c) + thrown;
}

double FallHeight(const Case& c, const Vessel& vessel, const engine::Pour& pour) {
  return DropHeight(c, vessel) + pour.slab() + vessel.region.base.z - vessel.Floor();
}

double MouthDiameter(const Case& c, const Vessel& vessel) {
  return MouthFor(LargestDiameter(c), c, vessel);
}

engine::Pour MakePour(const Case& c, const Vessel& vessel) {
  const engine::Vec3 foot = vessel.region.base;
  engine::PourPlan plan{
      .radii = DrawRadii(c),
      .material = 0,
      .density = c.powder.material.density,
      .mouth = {foot.x, foot.y, foot.z + DropHeight(c, vessel)},
      .rise = vessel.funnel ? 0 : 1 / (kFollowed * c.powder.material.density * vessel.area),
      .clearance = {},
      .mouth_diameter = MouthDiameter(c, vessel),
      .rate = 0,
      .scatter = c.filling.scatter.value_or(0),
      .start = 0,
      .gravity = {0, 0, -c.gravity},
      .seed = c.seed,
      .first_id = 0};
  if (vessel.funnel && vessel.funnel->follows) plan.clearance = vessel.funnel->height;
  plan.rate = c.filling.rate ? *c.filling.rate : UsualRate(plan, c, vessel);
  return engine::Pour(std::move(plan));
}

// With m = (4/3) π ρ R³: (δ/R)^(5/2) = (5π/4) ρ v²/E* on a wall, and √2/2 of it between like
// grains.
double BlowShare(const Case& c, double square_speed) {
  const double scale = 5 * std::numbers::pi / 4 * c.powder.material.density * square_speed;
  const engine::Material powder = UsedMaterial(c);
  const auto share = [&](const engine::Material& other, double factor) {
    const double e_star = engine::MakePairConstants(powder, other, c.models).y_star;
    return std::pow(factor * scale / e_star, 0.4);
  };
  const std::vector<engine::Material> materials = MaterialsOf(c);
  return std::max({share(powder, std::numbers::sqrt2 / 2), share(materials[kFloor], 1),
                   share(materials[kWalls], 1)});
}

double ImpactShare(const Case& c, const Vessel& vessel) {
  const engine::Pour pour = MakePour(c, vessel);
  const double fall = FallHeight(c, vessel, pour);
  return BlowShare(c, std::pow(engine::StreamSpeed(pour.plan()), 2) + 2 * c.gravity * fall);
}

}  // namespace talus::rigs
