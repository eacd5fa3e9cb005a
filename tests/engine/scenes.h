// Small scenes that several tests of the engine start from.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/laws/pair_constants.h"
#include "engine/simulation.h"

namespace talus::engine::testing {

inline Material Glass() {
  return {.density = 2500,
          .youngs_modulus = 1e7,
          .poisson_ratio = 0.3,
          .restitution = 0.9,
          .sliding_friction = 0.5,
          .rolling_friction = 0.1,
          .rolling_damping = 0.3};
}

inline Wall Floor() {
  return {.name = "floor", .shape = Plane{.point = {0, 0, 0}, .normal = {0, 0, 1}}};
}

// Nothing but one material, no gravity, no rolling resistance.
inline Scene EmptySpace(const Material& material) {
  Scene scene;
  scene.materials = {material};
  scene.models.rolling = Rolling::kNone;
  scene.gravity = {0, 0, 0};
  return scene;
}

// Every law that a contact can have.
inline std::vector<ContactModels> AllModels() {
  std::vector<ContactModels> all;
  for (const Adhesion adhesion : {Adhesion::kNone, Adhesion::kDmt, Adhesion::kJkr}) {
    for (const Rolling rolling :
         {Rolling::kNone, Rolling::kConstant, Rolling::kViscous, Rolling::kEpsd, Rolling::kEpsd2}) {
      all.push_back({.adhesion = adhesion, .rolling = rolling});
    }
  }
  all.push_back({.coulomb_limit = CoulombLimit::kElasticForce});
  all.push_back({.adhesion = Adhesion::kJkr,
                 .jkr_rolling_limit = JkrRollingLimit::kFromPullOff,
                 .jkr_sliding_spring = JkrSlidingSpring::kShortened});
  return all;
}

inline std::string NameOf(const ContactModels& models) {
  const auto name = [](auto value) { return std::string(base::NameOf(value)); };
  return name(models.adhesion) + ", " + name(models.rolling) + ", " + name(models.coulomb_limit) +
         ", " + name(models.jkr_sliding_spring);
}

// Length of an undamped Hertz impact: 2.9432… δ_max/v, with (15/16) m* v² = Y* √R* δ_max^(5/2).
struct HertzImpact {
  double y_star, r_star, m_star, speed;

  double MaxOverlap() const {
    return std::pow(15.0 / 16 * m_star * speed * speed / (y_star * std::sqrt(r_star)), 0.4);
  }
  double Duration() const { return 2.943275 * MaxOverlap() / speed; }
};

}  // namespace talus::engine::testing
