#include "engine/laws/material.h"

namespace talus::engine {

void Material::Validate(base::Problems& problems) const {
  problems.Require(density > 0, "density", density, "must be positive");
  problems.Require(youngs_modulus > 0, "youngs_modulus", youngs_modulus, "must be positive");
  problems.Require(poisson_ratio > -1 && poisson_ratio <= 0.5, "poisson_ratio", poisson_ratio,
                   "must be in (-1, 0.5]");
  problems.Require(restitution > 0 && restitution <= 1, "restitution", restitution,
                   "must be in (0, 1]");
  problems.Require(sliding_friction >= 0, "sliding_friction", sliding_friction,
                   "must not be negative");
  problems.Require(rolling_friction >= 0, "rolling_friction", rolling_friction,
                   "must not be negative");
  // What nothing rubs like: an overflow of the laws otherwise.
  constexpr double kMost = 1e6;
  problems.Require(!(sliding_friction > kMost), "sliding_friction", sliding_friction,
                   "must be at most 1e6");
  problems.Require(!(rolling_friction > kMost), "rolling_friction", rolling_friction,
                   "must be at most 1e6");
  problems.Require(!(rolling_damping > kMost), "rolling_damping", rolling_damping,
                   "must be at most 1e6");
  problems.Require(rolling_damping >= 0, "rolling_damping", rolling_damping,
                   "must not be negative");
  problems.Require(surface_energy >= 0, "surface_energy", surface_energy, "must not be negative");
  problems.Require(hamaker_constant > 0, "hamaker_constant", hamaker_constant, "must be positive");
}

void ContactModels::Validate(base::Problems& problems) const {
  problems.Require(full_mobilisation_damping >= 0 && full_mobilisation_damping <= 1,
                   "full_mobilisation_damping", full_mobilisation_damping, "must be in [0, 1]");
  problems.Require(adhesion_cutoff > 0 && adhesion_cutoff < 1, "adhesion_cutoff", adhesion_cutoff,
                   "must be in (0, 1)");
  const ContactModels usual;
  problems.Require(adhesion == Adhesion::kJkr || jkr_rolling_limit == usual.jkr_rolling_limit,
                   "jkr_rolling_limit", "has no effect: adhesion is not jkr");
  problems.Require(adhesion == Adhesion::kJkr || jkr_sliding_spring == usual.jkr_sliding_spring,
                   "jkr_sliding_spring", "has no effect: adhesion is not jkr");
  problems.Require(adhesion == Adhesion::kDmt || adhesion_cutoff == usual.adhesion_cutoff,
                   "adhesion_cutoff", adhesion_cutoff, "has no effect: adhesion is not dmt");
  problems.Require(rolling == Rolling::kEpsd || full_mobilisation_damping == 0,
                   "full_mobilisation_damping", full_mobilisation_damping,
                   "has no effect: rolling is not epsd");
  if (coulomb_limit == CoulombLimit::kElasticForce && adhesion != Adhesion::kNone) {
    problems.Add("coulomb_limit",
                 "elastic_force is a law without adhesion: set adhesion to none, or "
                 "leave total_force");
  }
}

}  // namespace talus::engine
