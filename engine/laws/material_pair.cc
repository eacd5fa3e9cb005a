#include "engine/laws/material_pair.h"

namespace talus::engine {

// A stated value has the bounds that a material's has.
void PairProperties::Validate(base::Problems& problems) const {
  With(Material(), *this).Validate(problems);
}

bool PairProperties::Any() const {
  return restitution || sliding_friction || rolling_friction || rolling_damping || surface_energy ||
         hamaker_constant;
}

PairProperties StatedOf(std::span<const MaterialPair> pairs, int a, int b) {
  for (const MaterialPair& pair : pairs) {
    if (pair.Joins(a, b)) return pair.stated;
  }
  return {};
}

Material With(Material material, const PairProperties& stated) {
  material.restitution = stated.restitution.value_or(material.restitution);
  material.sliding_friction = stated.sliding_friction.value_or(material.sliding_friction);
  material.rolling_friction = stated.rolling_friction.value_or(material.rolling_friction);
  material.rolling_damping = stated.rolling_damping.value_or(material.rolling_damping);
  material.surface_energy = stated.surface_energy.value_or(material.surface_energy);
  material.hamaker_constant = stated.hamaker_constant.value_or(material.hamaker_constant);
  return material;
}

}  // namespace talus::engine
