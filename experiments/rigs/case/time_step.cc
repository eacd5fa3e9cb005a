#include "experiments/rigs/case/time_step.h"

#include <algorithm>

#include "engine/bodies/particle.h"
#include "engine/laws/pair_constants.h"
#include "engine/laws/pressed_bed.h"
#include "engine/laws/rolling_step.h"
#include "engine/scene/size_distribution.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"

namespace talus::rigs {
namespace {

// What presses the grains together: their weight, and a lid [Pa].
double Stress(const Case& c) {
  const double density = c.powder.material.density;
  const double weight = engine::BedStress(density, c.gravity, c.powder.mass / density);
  const std::vector<double>& lids = c.rig.shear_cell.stresses;
  return c.rig.kind == RigKind::kShearCell && !lids.empty() ? weight + lids.back() : weight;
}

}  // namespace

double StepFraction(const Case& c) {
  if (c.models.rolling != engine::Rolling::kEpsd) return c.rayleigh_fraction;
  const engine::Material powder =
      engine::With(UsedMaterial(c), engine::StatedOf(PairsOf(c), kPowder, kPowder));
  const double radius =
      c.coarse_graining.scale_factor * engine::SizeCurve(c.powder.sizes).smallest() / 2;
  const double longest = engine::LongestRollingStep(
      engine::MakePairConstants(powder, powder, c.models),
      {.radius = radius, .density = powder.density, .stress = Stress(c)});
  return std::min(c.rayleigh_fraction, longest / engine::RayleighTime(powder, radius));
}

}  // namespace talus::rigs
