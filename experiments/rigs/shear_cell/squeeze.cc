#include "experiments/rigs/shear_cell/squeeze.h"

#include <cmath>

#include "engine/laws/pressed_bed.h"
#include "experiments/rigs/case/materials.h"

namespace talus::rigs {

double SqueezeShare(const Case& c, double stress) {
  const engine::Material powder = UsedMaterial(c);
  return engine::PressedOverlap(engine::MakePairConstants(powder, powder, c.models), stress);
}

double BearableStress(const Case& c) { return std::pow(kMaxSqueeze / SqueezeShare(c, 1), 1.5); }

double SqueezedModulus(const Case& c, double stress) {
  return 3 * stress / SqueezeShare(c, stress);
}

}  // namespace talus::rigs
