// What is heaped: the material, the sizes and the mass of a powder, and its coarse graining.
#pragma once

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material.h"
#include "engine/scene/size_distribution.h"

namespace talus::rigs {

struct Powder {
  engine::Material material;
  engine::SizeDistribution sizes;  // of the real powder; the scale factor enlarges it
  double mass = 0;                 // [kg], > 0; 0: not given, as a drum's fill stands for it

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("material", self.material, {.doc = "of a grain"});
    visit("sizes", self.sizes, {.required = true, .doc = "diameters of the real powder"});
    visit("mass", self.mass,
          {.dimension = base::Dimension::kMass,
           .doc = "filled, > 0; a drum may have its rig's fill instead"});
  }
  void Validate(base::Problems& problems) const;
};

// Fewer, larger grains (docs/physics.md, C1).
struct CoarseGraining {
  double scale_factor = 1;             // f [-], >= 1: every diameter is multiplied by it
  double surface_energy_exponent = 1;  // p [-], in [0, 3]: γ_used = f^p γ

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor,
          {.doc = "f: every diameter is multiplied by it, mass and device stay; >= 1"});
    visit("surface_energy_exponent", self.surface_energy_exponent,
          {.doc = "p in gamma_used = f^p gamma: 1 cohesive stress over weight, 2 particle Bond "
                  "number, 0 none; in [0, 3]"});
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::rigs
