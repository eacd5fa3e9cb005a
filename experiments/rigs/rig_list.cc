#include "experiments/rigs/rig_list.h"

#include <cstddef>
#include <iterator>
#include <utility>

namespace talus::rigs {
namespace {

constexpr const RigEntry* kRigs[] = {
    &kLiftedTubeRig, &kTappedDensityRig, &kColumnCollapseRig, &kTiltingBoxRig, &kDrawDownRig,
    &kDrumRig,       &kOrificeFlowRig,   &kFunnelHeapRig,     &kSpreadingRig,  &kShearCellRig};

static_assert(std::size(kRigs) == static_cast<std::size_t>(LastOf(RigKind{})) + 1);

}  // namespace

const RigEntry& EntryOf(const Case& rig_case) {
  const RigEntry* const* found = kRigs;
  while ((*found)->kind != rig_case.rig.kind) ++found;
  return **found;
}

std::unique_ptr<Rig> MakeRig(const Case& rig_case) { return EntryOf(rig_case).make(rig_case); }

std::unique_ptr<Rig> RestoreRig(const Case& rig_case, const std::string& state,
                                engine::Simulation simulation) {
  return EntryOf(rig_case).restore(rig_case, state, std::move(simulation));
}

}  // namespace talus::rigs
