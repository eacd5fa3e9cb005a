// What the heap test is made with: a tube that is lifted off a plate (docs/physics.md, 7).
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/field.h"
#include "base/problems.h"
#include "engine/scene/material.h"

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
  std::optional<double> surface_energy{};    // [J/m²], not scaled by the coarse graining
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
          {.dimension = Dimension::kSurfaceEnergy, .doc = "used as given: not coarse-grained"});
    visit("hamaker_constant", self.hamaker_constant,
          {.dimension = Dimension::kEnergy, .doc = "Hamaker constant of the DMT model, > 0"});
  }
  void Validate(base::Problems& problems) const;

  // The wall's whole material: `powder` with what is given here put in its place.
  engine::Material Over(const engine::Material& powder) const;
};

enum class PlateKind { kSolidCylinder, kDisc };

struct Device {
  double tube_inner_diameter = 0.01;    // D_i [m], > 0
  std::optional<double> tube_length{};  // [m]; default: what the mass needs when loosely poured
  double plate_diameter = 0.01;         // D_b [m], > 0
  PlateKind plate = PlateKind::kSolidCylinder;
  double plate_height = 0.005;  // of the solid cylinder [m], > 0
  double lift_velocity = 0.01;  // v_l [m/s], > 0
  std::optional<WallMaterial> tube_material{};
  std::optional<WallMaterial> plate_material{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("tube_inner_diameter", self.tube_inner_diameter,
          {.dimension = Dimension::kLength, .doc = "of the lifted tube, > 0"});
    visit("tube_length", self.tube_length,
          {.dimension = Dimension::kLength, .doc = "default: what the mass needs"});
    visit("plate_diameter", self.plate_diameter,
          {.dimension = Dimension::kLength, .doc = "that the heap stands on, > 0"});
    visit("plate", self.plate,
          {.doc = "solid_cylinder: its rim and side are walls too; disc: no thickness"});
    visit("plate_height", self.plate_height,
          {.dimension = Dimension::kLength, .doc = "of the solid cylinder, > 0"});
    visit("lift_velocity", self.lift_velocity,
          {.dimension = Dimension::kVelocity, .doc = "of the tube, > 0"});
    visit("tube_material", self.tube_material, {.doc = "where it differs from the powder's"});
    visit("plate_material", self.plate_material, {.doc = "where it differs from the powder's"});
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::rigs

template <>
struct talus::base::Names<talus::rigs::PlateKind> {
  using P = talus::rigs::PlateKind;
  static constexpr std::array kList{std::pair{"solid_cylinder", P::kSolidCylinder},
                                    std::pair{"disc", P::kDisc}};
};
