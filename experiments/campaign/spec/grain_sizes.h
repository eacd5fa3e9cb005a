// At which grain sizes a campaign simulates: one scale factor, or several of which the smallest, or
// one smaller still, is the target that the answer is for.
#pragma once

#include <optional>
#include <vector>

#include "base/field.h"
#include "base/problems.h"

namespace talus::campaign {

struct GrainSizes {
  double scale_factor = 1;                             // f [-], >= 1; the least of scale_factors
  std::optional<std::vector<double>> scale_factors{};  // distinct, >= 1
  std::optional<double> target{};                      // >= 1, at most the least scale factor
  double surface_energy_exponent = 1;                  // p [-], in [0, 3]: γ_used = f^p γ

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor,
          {.doc = "f: every diameter is multiplied by it, mass and device stay; >= 1"});
    visit("scale_factors", self.scale_factors,
          {.doc = "instead of scale_factor: simulate at several, each where it teaches most about "
                  "the smallest for its cost; distinct, >= 1"});
    visit("target", self.target,
          {.doc = "scale factor that the answer is for, where it is less than all that are "
                  "simulated; >= 1"});
    visit("surface_energy_exponent", self.surface_energy_exponent,
          {.doc = "p in gamma_used = f^p gamma: 1 cohesive stress over weight, 2 particle Bond "
                  "number, 0 none; in [0, 3]"});
  }
  void Validate(base::Problems& problems) const;

  std::vector<double> Levels() const;  // the scale factors that are simulated, the coarsest first
  double Target() const;               // that the answer is for
  double Finest() const { return Levels().back(); }  // of those that are simulated
  // Whether trials of several sizes are put together, or a size is told that nobody simulates.
  bool AreSeveral() const { return Levels().size() > 1 || Target() < Levels().back(); }
};

}  // namespace talus::campaign
