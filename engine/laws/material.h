// What the contact laws know of a material, and which laws act. Symbols as in docs/physics.md.
#pragma once

#include <array>
#include <string>

#include "base/field.h"
#include "base/problems.h"

namespace talus::engine {

// Surface and bulk properties; a pair's are formed from two of these by P3–P7.
struct Material {
  double density = 2500;            // ρ [kg/m³], > 0
  double youngs_modulus = 1e7;      // Y [Pa], > 0
  double poisson_ratio = 0.3;       // ν [-], in (-1, 0.5]
  double restitution = 0.9;         // e [-], in (0, 1]
  double sliding_friction = 0.5;    // μ_t [-], >= 0
  double rolling_friction = 0.1;    // μ_r [-], >= 0
  double rolling_damping = 0.3;     // η_r [-], >= 0, of the EPSD model (R3)
  double surface_energy = 0;        // γ [J/m²], >= 0, of one surface (P6)
  double hamaker_constant = 4e-19;  // A [J], > 0, of the DMT model (A2, A3)

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("density", self.density,
          {.dimension = Dimension::kDensity, .doc = "solid density of a grain, > 0"});
    visit("youngs_modulus", self.youngs_modulus,
          {.dimension = Dimension::kPressure, .doc = "Young's modulus, > 0"});
    visit("poisson_ratio", self.poisson_ratio, {.doc = "Poisson's ratio, in (-1, 0.5]"});
    visit("restitution", self.restitution, {.doc = "coefficient of restitution, in (0, 1]"});
    visit("sliding_friction", self.sliding_friction, {.doc = "sliding friction mu_t, >= 0"});
    visit("rolling_friction", self.rolling_friction, {.doc = "rolling friction mu_r, >= 0"});
    visit("rolling_damping", self.rolling_damping,
          {.doc = "rolling viscous damping ratio eta_r of the EPSD model, >= 0"});
    visit("surface_energy", self.surface_energy,
          {.dimension = Dimension::kSurfaceEnergy, .doc = "surface energy of one surface, >= 0"});
    visit("hamaker_constant", self.hamaker_constant,
          {.dimension = Dimension::kEnergy, .doc = "Hamaker constant of the DMT model, > 0"});
  }
  void Validate(base::Problems& problems) const;
};

enum class Adhesion { kNone, kDmt, kJkr };
constexpr Adhesion LastOf(Adhesion) { return Adhesion::kJkr; }
enum class Rolling { kNone, kConstant, kViscous, kEpsd, kEpsd2 };
constexpr Rolling LastOf(Rolling) { return Rolling::kEpsd2; }

// Which normal force of JKR bounds the rolling torque (A6): the net one, or that above the
// pull-off.
enum class JkrRollingLimit { kNetForce, kFromPullOff };
constexpr JkrRollingLimit LastOf(JkrRollingLimit) { return JkrRollingLimit::kFromPullOff; }

// What a tangential spring of JKR between two spheres does while it slides (A7).
enum class JkrSlidingSpring { kKept, kShortened };
constexpr JkrSlidingSpring LastOf(JkrSlidingSpring) { return JkrSlidingSpring::kShortened; }

// Which normal force bounds friction: all of it (T2), or its elastic part (T4).
enum class CoulombLimit { kTotalForce, kElasticForce };
constexpr CoulombLimit LastOf(CoulombLimit) { return CoulombLimit::kElasticForce; }

// Which laws act between all bodies of a scene.
struct ContactModels {
  Adhesion adhesion = Adhesion::kNone;
  Rolling rolling = Rolling::kEpsd;
  double full_mobilisation_damping =
      0;  // f [-], in [0, 1]: share of damping once the limit is reached (R4)
  double adhesion_cutoff = 0.1;  // C [-], in (0, 1): DMT force at which the gap range ends (A2)
  JkrRollingLimit jkr_rolling_limit = JkrRollingLimit::kNetForce;
  JkrSlidingSpring jkr_sliding_spring = JkrSlidingSpring::kKept;
  CoulombLimit coulomb_limit = CoulombLimit::kTotalForce;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("adhesion", self.adhesion, {.doc = "adhesion between surfaces"});
    visit("rolling", self.rolling, {.doc = "rolling resistance"});
    visit(
        "full_mobilisation_damping", self.full_mobilisation_damping,
        {.doc = "f of the EPSD model: share of its damping once the limit is reached, in [0, 1]"});
    visit(
        "adhesion_cutoff", self.adhesion_cutoff,
        {.doc =
             "C of the DMT model: share of the pull-off force at which its range ends, in (0, 1)"});
    visit("jkr_rolling_limit", self.jkr_rolling_limit,
          {.doc = "net_force, as published: mu_r R* times the normal force; from_pull_off: times "
                  "the normal force plus 3 pi gamma* R*"});
    visit("jkr_sliding_spring", self.jkr_sliding_spring,
          {.doc = "kept, as published: between spheres the tangential spring grows on while it "
                  "slides; shortened: to its limit, as against walls"});
    visit(
        "coulomb_limit", self.coulomb_limit,
        {.doc = "what times mu_t bounds friction: total_force, as published, spring and dashpot of "
                "the normal force; elastic_force, its spring alone, without adhesion"});
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::engine
