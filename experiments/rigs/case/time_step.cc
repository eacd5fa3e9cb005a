#include "experiments/rigs/case/time_step.h"

#include <algorithm>

#include "engine/bodies/particle.h"
#include "engine/laws/pair_constants.h"
#include "engine/laws/pressed_bed.h"
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

engine::Material GrainsOf(const Case& c) {
  return engine::With(UsedMaterial(c), engine::StatedOf(PairsOf(c), kPowder, kPowder));
}

double SmallestRadius(const Case& c) {
  return c.coarse_graining.scale_factor * engine::SizeCurve(c.powder.sizes).smallest() / 2;
}

engine::StepLimit Limit(const Case& c) {
  const engine::Material powder = GrainsOf(c);
  return engine::LongestStep(
      engine::MakePairConstants(powder, powder, c.models),
      {.radius = SmallestRadius(c), .density = powder.density, .stress = Stress(c)},
      c.models.rolling);
}

}  // namespace

double StepFraction(const Case& c) {
  return std::min(c.rayleigh_fraction,
                  Limit(c).step / engine::RayleighTime(GrainsOf(c), SmallestRadius(c)));
}

engine::StepBound BoundOf(const Case& c) { return Limit(c).bound; }

}  // namespace talus::rigs
