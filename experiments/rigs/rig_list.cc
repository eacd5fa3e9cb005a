#include "experiments/rigs/rig_list.h"

#include <utility>

#include "experiments/rigs/column_collapse/column_collapse_rig.h"
#include "experiments/rigs/draw_down/draw_down_rig.h"
#include "experiments/rigs/drum/drum_rig.h"
#include "experiments/rigs/funnel_heap/funnel_heap_rig.h"
#include "experiments/rigs/lifted_tube/lifted_tube_rig.h"
#include "experiments/rigs/orifice_flow/orifice_flow_rig.h"
#include "experiments/rigs/shear_cell/shear_cell_rig.h"
#include "experiments/rigs/spreading/spreading_rig.h"
#include "experiments/rigs/tapped_density/tapped_density_rig.h"
#include "experiments/rigs/tilting_box/tilting_box_rig.h"

namespace talus::rigs {
namespace {

template <class R>
std::unique_ptr<Rig> Make(const Case& c) {
  FilledRig filled = FillRig(c, R::VesselOf(c), &R::Walls);
  return std::make_unique<R>(c, typename R::State{.common = std::move(filled.state), .memory = {}},
                             std::move(filled.simulation));
}

template <class R>
std::unique_ptr<Rig> Restore(const Case& c, const std::string& state,
                             engine::Simulation simulation) {
  return std::make_unique<R>(c, R::ParseState(state), std::move(simulation));
}

template <class R>
constexpr RigEntry Entry(RigKind kind) {
  return {.kind = kind,
          .make = &Make<R>,
          .restore = &Restore<R>,
          .vessel = &R::VesselOf,
          .walls = &R::Walls,
          .observables = R::kMeasured,
          .validate = &R::Validate,
          .width = &R::Width,
          .test_time = &R::TestTime};
}

constexpr RigEntry kRigs[] = {
    Entry<LiftedTubeRig>(RigKind::kLiftedTube),
    Entry<TappedDensityRig>(RigKind::kTappedDensity),
    Entry<ColumnCollapseRig>(RigKind::kColumnCollapse),
    Entry<TiltingBoxRig>(RigKind::kTiltingBox),
    Entry<DrawDownRig>(RigKind::kDrawDown),
    Entry<DrumRig>(RigKind::kDrum),
    Entry<OrificeFlowRig>(RigKind::kOrificeFlow),
    Entry<FunnelHeapRig>(RigKind::kFunnelHeap),
    Entry<SpreadingRig>(RigKind::kSpreading),
    Entry<ShearCellRig>(RigKind::kShearCell),
};

}  // namespace

const RigEntry& EntryOf(const Case& rig_case) {
  const RigEntry* found = kRigs;
  while (found->kind != rig_case.rig.kind) ++found;
  return *found;
}

std::unique_ptr<Rig> MakeRig(const Case& rig_case) { return EntryOf(rig_case).make(rig_case); }

std::unique_ptr<Rig> RestoreRig(const Case& rig_case, const std::string& state,
                                engine::Simulation simulation) {
  return EntryOf(rig_case).restore(rig_case, state, std::move(simulation));
}

}  // namespace talus::rigs
