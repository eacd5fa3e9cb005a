// What a pair of materials states itself, in place of what follows from the two: (P8).
//
//   e, μ_t, μ_r, η_r, γ, A as stated for the pair         where stated; else (P5)–(P7)
//
// A stated value acts as if both materials had it, so that γ* = 2γ. Moduli always follow from the
// materials (P3, P4).
#pragma once

#include <optional>
#include <span>

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material.h"

namespace talus::engine {

struct PairProperties {
  std::optional<double> restitution{};       // e [-], in (0, 1]
  std::optional<double> sliding_friction{};  // μ_t [-], >= 0
  std::optional<double> rolling_friction{};  // μ_r [-], >= 0
  std::optional<double> rolling_damping{};   // η_r [-], >= 0
  std::optional<double> surface_energy{};    // γ [J/m²], >= 0
  std::optional<double> hamaker_constant{};  // A [J], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("restitution", self.restitution, {.doc = "coefficient of restitution, in (0, 1]"});
    visit("sliding_friction", self.sliding_friction, {.doc = "sliding friction mu_t, >= 0"});
    visit("rolling_friction", self.rolling_friction, {.doc = "rolling friction mu_r, >= 0"});
    visit("rolling_damping", self.rolling_damping,
          {.doc = "rolling viscous damping ratio eta_r of the EPSD model, >= 0"});
    visit("surface_energy", self.surface_energy,
          {.dimension = Dimension::kSurfaceEnergy,
           .doc = "as if both surfaces had it: gamma* is twice this; >= 0"});
    visit("hamaker_constant", self.hamaker_constant,
          {.dimension = Dimension::kEnergy, .doc = "Hamaker constant of the DMT model, > 0"});
  }
  void Validate(base::Problems& problems) const;
  bool Any() const;  // whether anything is stated
};

// Two materials of a scene; the order does not matter, and both may be the same.
struct MaterialPair {
  int first = 0;   // index into Scene::materials
  int second = 0;  // the same
  PairProperties stated{};

  bool Joins(int a, int b) const {
    return (first == a && second == b) || (first == b && second == a);
  }
};

// What the pair of materials a and b states; nothing unless it is in the list.
PairProperties StatedOf(std::span<const MaterialPair> pairs, int a, int b);

// The material with what is stated in place of its own.
Material With(Material material, const PairProperties& stated);

// All that acts between two materials, stated or mixed by (P5) to (P7): what both would have if
// they were equal.
PairProperties Joined(const Material& a, const Material& b, const PairProperties& stated);

}  // namespace talus::engine
