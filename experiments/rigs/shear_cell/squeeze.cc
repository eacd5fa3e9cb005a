#include "experiments/rigs/shear_cell/squeeze.h"

#include <cmath>
#include <numbers>

#include "engine/laws/pair_constants.h"
#include "experiments/rigs/case/materials.h"

namespace talus::rigs {

double SqueezeShare(const Case& c, double stress) {
  constexpr double kContacts = 0.58 * 4.5;  // φ Z
  const engine::Material powder = UsedMaterial(c);
  const double e_star = engine::MakePairConstants(powder, powder, c.models).y_star;
  return std::pow(3 * std::numbers::sqrt2 * std::numbers::pi * stress / (kContacts * e_star),
                  2.0 / 3);
}

double BearableStress(const Case& c) { return std::pow(kMaxSqueeze / SqueezeShare(c, 1), 1.5); }

double SqueezedModulus(const Case& c, double stress) {
  return 3 * stress / SqueezeShare(c, stress);
}

}  // namespace talus::rigs
