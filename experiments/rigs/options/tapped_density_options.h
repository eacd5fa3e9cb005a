// A cylinder of powder that is tapped until it packs no denser.
#pragma once

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/filling_rule.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

struct TappedDensityOptions {
  double diameter = 0.02;  // of the cylinder [m], > 0
  // Stroke of ASTM B527 (3 mm); a test there takes thousands of taps, most of which change little.
  TapRule taps{.count = 20, .height = 3e-3, .interval = 0.12};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("diameter", self.diameter,
          {.dimension = base::Dimension::kLength, .doc = "inner one of the cylinder, > 0"});
    visit("taps", self.taps, {.doc = "after the powder has settled"});
  }
  void Validate(base::Problems& problems) const { RequireLength(problems, "diameter", diameter); }
};

}  // namespace talus::rigs
