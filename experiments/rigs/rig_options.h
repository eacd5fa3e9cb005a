// Which bulk test a case is of, and what that test is made with.
#pragma once

#include <array>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/column_collapse/column_collapse_options.h"
#include "experiments/rigs/draw_down/draw_down_options.h"
#include "experiments/rigs/drum/drum_options.h"
#include "experiments/rigs/tapped_density/tapped_density_options.h"
#include "experiments/rigs/tilting_box/tilting_box_options.h"

namespace talus::rigs {

enum class RigKind { kLiftedTube, kTappedDensity, kColumnCollapse, kTiltingBox, kDrawDown, kDrum };

// The keys of one kind only are there: those of `kind`. The lifted tube's are `device`.
struct RigOptions {
  RigKind kind = RigKind::kLiftedTube;
  TappedDensityOptions tapped_density;
  ColumnCollapseOptions column_collapse;
  TiltingBoxOptions tilting_box;
  DrawDownOptions draw_down;
  DrumOptions drum;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind, {.doc = "of bulk test; the keys beside it are that test's"});
    OfKind(self, [&](auto& options) { options.Visit(options, visit); });
  }
  void Validate(base::Problems& problems) const {
    OfKind(*this, [&](const auto& options) { options.Validate(problems); });
  }

  // One of each kind, for the schema.
  static std::vector<RigOptions> Alternatives();

 private:
  // Calls `body` with the options of the kind, if it has any.
  template <class Self, class Body>
  static void OfKind(Self& self, Body&& body) {
    switch (self.kind) {
      case RigKind::kLiftedTube:
        return;
      case RigKind::kTappedDensity:
        return body(self.tapped_density);
      case RigKind::kColumnCollapse:
        return body(self.column_collapse);
      case RigKind::kTiltingBox:
        return body(self.tilting_box);
      case RigKind::kDrawDown:
        return body(self.draw_down);
      case RigKind::kDrum:
        return body(self.drum);
    }
  }
};

}  // namespace talus::rigs

template <>
struct talus::base::Names<talus::rigs::RigKind> {
  using R = talus::rigs::RigKind;
  static constexpr std::array kList{std::pair{"lifted_tube", R::kLiftedTube},
                                    std::pair{"tapped_density", R::kTappedDensity},
                                    std::pair{"column_collapse", R::kColumnCollapse},
                                    std::pair{"tilting_box", R::kTiltingBox},
                                    std::pair{"draw_down", R::kDrawDown},
                                    std::pair{"drum", R::kDrum}};
};
