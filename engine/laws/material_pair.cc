#include "engine/laws/material_pair.h"

#include <cmath>

#include "engine/laws/pair_constants.h"

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

PairProperties Joined(const Material& a, const Material& b, const PairProperties& stated) {
  const auto mean = [&](double Material::*part) { return HarmonicMean(a.*part, b.*part); };
  return {.restitution = stated.restitution.value_or(mean(&Material::restitution)),
          .sliding_friction = stated.sliding_friction.value_or(mean(&Material::sliding_friction)),
          .rolling_friction = stated.rolling_friction.value_or(mean(&Material::rolling_friction)),
          .rolling_damping = stated.rolling_damping.value_or(mean(&Material::rolling_damping)),
          // γ*/2 of (P6), which is the geometric mean.
          .surface_energy =
              stated.surface_energy.value_or(std::sqrt(a.surface_energy * b.surface_energy)),
          .hamaker_constant =
              stated.hamaker_constant.value_or((a.hamaker_constant + b.hamaker_constant) / 2)};
}

}  // namespace talus::engine
