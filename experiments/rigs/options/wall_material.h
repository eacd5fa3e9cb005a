// What the walls and the floor of a rig are made of.
#pragma once

#include <optional>
#include <string>

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material.h"

namespace talus::rigs {

// Properties of a wall that differ from the powder's; what is not given is the powder's.
struct WallMaterial {
  std::optional<std::string> name{};         // one name stands for one set of properties
  std::optional<double> youngs_modulus{};    // [Pa]
  std::optional<double> poisson_ratio{};     // [-]
  std::optional<double> restitution{};       // [-]
  std::optional<double> sliding_friction{};  // [-]
  std::optional<double> rolling_friction{};  // [-]
  std::optional<double> rolling_damping{};   // [-]
  std::optional<double> surface_energy{};    // [J/m²], before the coarse graining
  std::optional<double> hamaker_constant{};  // [J]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit(
        "name", self.name,
        {.doc = "of the material, such as glass: walls of one name must have the same properties"});
    visit("youngs_modulus", self.youngs_modulus,
          {.dimension = Dimension::kPressure, .doc = "Young's modulus, > 0"});
    visit("poisson_ratio", self.poisson_ratio, {.doc = "Poisson's ratio, in (-1, 0.5]"});
    visit("restitution", self.restitution, {.doc = "coefficient of restitution, in (0, 1]"});
    visit("sliding_friction", self.sliding_friction, {.doc = "sliding friction mu_t, >= 0"});
    visit("rolling_friction", self.rolling_friction, {.doc = "rolling friction mu_r, >= 0"});
    visit("rolling_damping", self.rolling_damping, {.doc = "rolling damping ratio eta_r, >= 0"});
    visit("surface_energy", self.surface_energy,
          {.dimension = Dimension::kSurfaceEnergy,
           .doc = "surface energy, >= 0; coarse-grained as the powder's is"});
    visit("hamaker_constant", self.hamaker_constant,
          {.dimension = Dimension::kEnergy, .doc = "Hamaker constant of the DMT model, > 0"});
  }
  void Validate(base::Problems& problems) const { Over({}).Validate(problems); }

  // The wall's whole material: `powder` with what is given here put in its place.
  engine::Material Over(const engine::Material& powder) const {
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
};

// What is not given is made of what the grains are made of.
struct WallMaterials {
  std::optional<WallMaterial> walls{};
  std::optional<WallMaterial> floor{};
};

}  // namespace talus::rigs
