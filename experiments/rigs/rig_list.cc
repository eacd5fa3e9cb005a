#include "experiments/rigs/rig_list.h"

#include <utility>

#include "experiments/rigs/column_collapse/column_collapse_rig.h"
#include "experiments/rigs/draw_down/draw_down_rig.h"
#include "experiments/rigs/drum/drum_rig.h"
#include "experiments/rigs/lifted_tube/heap_rig.h"
#include "experiments/rigs/tapped_density/tapped_density_rig.h"
#include "experiments/rigs/tilting_box/tilting_box_rig.h"

namespace talus::rigs {
namespace {

template <class R>
std::unique_ptr<Rig> Make(const HeapCase& c) {
  return std::make_unique<R>(c);
}

template <class R>
std::unique_ptr<Rig> Restore(const HeapCase& c, const std::string& state,
                             engine::Simulation simulation) {
  return std::make_unique<R>(c, R::ParseState(state), std::move(simulation));
}

template <class R>
constexpr RigEntry Entry(RigKind kind) {
  return {.kind = kind,
          .make = &Make<R>,
          .restore = &Restore<R>,
          .vessel = &R::VesselOf,
          .observables = R::kObservables,
          .validate = &R::Validate,
          .width = &R::Width,
          .test_time = &R::TestTime};
}

constexpr RigEntry kRigs[] = {
    Entry<HeapRig>(RigKind::kLiftedTube),
    Entry<TappedDensityRig>(RigKind::kTappedDensity),
    Entry<ColumnCollapseRig>(RigKind::kColumnCollapse),
    Entry<TiltingBoxRig>(RigKind::kTiltingBox),
    Entry<DrawDownRig>(RigKind::kDrawDown),
    Entry<DrumRig>(RigKind::kDrum),
};

}  // namespace

const RigEntry& EntryOf(const HeapCase& heap_case) {
  const RigEntry* found = kRigs;
  while (found->kind != KindOf(heap_case)) ++found;
  return *found;
}

int NumViewsOf(const HeapCase& heap_case) {
  return KindOf(heap_case) == RigKind::kLiftedTube ? heap_case.num_views : 1;
}

std::unique_ptr<Rig> MakeRig(const HeapCase& heap_case) {
  return EntryOf(heap_case).make(heap_case);
}

std::unique_ptr<Rig> RestoreRig(const HeapCase& heap_case, const std::string& state,
                                engine::Simulation simulation) {
  return EntryOf(heap_case).restore(heap_case, state, std::move(simulation));
}

// The endings that docs/rigs.md lists.
std::string UnitOfObservable(const std::string& name) {
  constexpr std::pair<const char*, const char*> kUnits[] = {
      {"_kg_per_m3", "kg/m3"}, {"_kg_per_s", "kg/s"}, {"_kg", "kg"}, {"_deg", "deg"},
      {"_mm2", "mm2"},         {"_mm", "mm"},         {"_m", "m"},   {"_s", "s"}};
  for (const auto& [ending, unit] : kUnits) {
    if (name.ends_with(ending)) return unit;
  }
  return "-";
}

}  // namespace talus::rigs
