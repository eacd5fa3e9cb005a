// Which bulk test a case is of, and what that test is made with.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/camera_options.h"
#include "experiments/rigs/options/column_collapse_options.h"
#include "experiments/rigs/options/draw_down_options.h"
#include "experiments/rigs/options/drum_options.h"
#include "experiments/rigs/options/funnel_heap_options.h"
#include "experiments/rigs/options/lifted_tube_options.h"
#include "experiments/rigs/options/orifice_flow_options.h"
#include "experiments/rigs/options/shear_cell_options.h"
#include "experiments/rigs/options/spreading_options.h"
#include "experiments/rigs/options/tapped_density_options.h"
#include "experiments/rigs/options/tilting_box_options.h"

namespace talus::rigs {

enum class RigKind {
  kLiftedTube,
  kTappedDensity,
  kColumnCollapse,
  kTiltingBox,
  kDrawDown,
  kDrum,
  kOrificeFlow,
  kFunnelHeap,
  kSpreading,
  kShearCell
};
constexpr RigKind LastOf(RigKind) { return RigKind::kShearCell; }

// Whether its powder moves when it is measured, so that a camera can take pictures of it.
constexpr bool IsFilmed(RigKind kind) {
  constexpr RigKind kFilmed[] = {RigKind::kColumnCollapse, RigKind::kTiltingBox, RigKind::kDrawDown,
                                 RigKind::kDrum, RigKind::kOrificeFlow};
  return std::ranges::find(kFilmed, kind) != std::end(kFilmed);
}

// Whether its powder ends as a round heap on a plate; in the others it lies in a drum, a box or a
// bed, and is measured from the front.
constexpr bool IsRoundHeap(RigKind kind) {
  return kind == RigKind::kLiftedTube || kind == RigKind::kFunnelHeap;
}

// The keys of one kind only are there: those of `kind`. The lifted tube's stand under `device`.
struct RigOptions {
  RigKind kind = RigKind::kLiftedTube;
  LiftedTubeOptions lifted_tube;
  TappedDensityOptions tapped_density;
  ColumnCollapseOptions column_collapse;
  TiltingBoxOptions tilting_box;
  DrawDownOptions draw_down;
  DrumOptions drum;
  OrificeFlowOptions orifice_flow;
  FunnelHeapOptions funnel_heap;
  SpreadingOptions spreading;
  ShearCellOptions shear_cell;
  std::optional<CameraOptions> camera{};  // default: one picture, at the end

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind,
          {.required = true, .doc = "of bulk test; the keys beside it are that test's"});
    OfKind(self, [&](auto& options) { options.Visit(options, visit); });
    visit("camera", self.camera,
          {.doc = "pictures over time, whose mean is the profile, of rigs whose powder moves; "
                  "default: one picture, at the end"});
  }
  void Validate(base::Problems& problems) const {
    OfKind(*this, [&](const auto& options) { options.Validate(problems); });
    problems.Require(!camera || IsFilmed(kind), "camera",
                     "has nothing to film: the powder of this rig is at rest when its picture is "
                     "taken; remove it");
  }

  // One of each kind, for the schema.
  static std::vector<RigOptions> Alternatives() {
    std::vector<RigOptions> all;
    for (const auto& [name, kind] : base::Names<RigKind>::kList) all.emplace_back().kind = kind;
    return all;
  }

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
      case RigKind::kOrificeFlow:
        return body(self.orifice_flow);
      case RigKind::kFunnelHeap:
        return body(self.funnel_heap);
      case RigKind::kSpreading:
        return body(self.spreading);
      case RigKind::kShearCell:
        return body(self.shear_cell);
    }
  }
};

// The lifted tube where none is given.
inline RigKind KindOf(const std::optional<RigOptions>& rig) {
  return rig ? rig->kind : RigKind::kLiftedTube;
}

}  // namespace talus::rigs
