// What the program knows of a rig before it runs: an entry each, defined beside the rig's class.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

struct RigEntry {
  RigKind kind;
  std::unique_ptr<Rig> (*make)(const Case&);
  std::unique_ptr<Rig> (*restore)(const Case&, const std::string& state, engine::Simulation);
  Vessel (*vessel)(const Case&);  // that the powder is filled into
  // Around it, as they stand at first, so that they hold powder of this height [m].
  std::vector<engine::Wall> (*walls)(const Case&, double height);
  std::span<const RigObservable> observables;
  // What the rig's own options cannot see by themselves.
  void (*validate)(const Case&, base::Problems&);
  double (*width)(const Case&);  // that its images are scaled by: of plate, drum or box [m]
  // Usually simulated beside filling, of powder that is filled to a height, with what it takes to
  // come to rest [s].
  double (*test_time)(const Case&, double filled_height);
};

// The entry of a class derived from RememberingRig, whose static functions have the names above.
template <class R>
constexpr RigEntry EntryFor(RigKind kind) {
  return {.kind = kind,
          .make = [](const Case& c) -> std::unique_ptr<Rig> {
            FilledRig filled = FillRig(c, R::VesselOf(c), &R::Walls);
            return std::make_unique<R>(
                c, typename R::State{.common = std::move(filled.state), .memory = {}},
                std::move(filled.simulation));
          },
          .restore = [](const Case& c, const std::string& state,
                        engine::Simulation simulation) -> std::unique_ptr<Rig> {
            return std::make_unique<R>(c, R::ParseState(state), std::move(simulation));
          },
          .vessel = &R::VesselOf,
          .walls = &R::Walls,
          .observables = R::kMeasured,
          .validate = &R::Validate,
          .width = &R::Width,
          .test_time = &R::TestTime};
}

extern const RigEntry kLiftedTubeRig;
extern const RigEntry kTappedDensityRig;
extern const RigEntry kColumnCollapseRig;
extern const RigEntry kTiltingBoxRig;
extern const RigEntry kDrawDownRig;
extern const RigEntry kDrumRig;
extern const RigEntry kOrificeFlowRig;
extern const RigEntry kFunnelHeapRig;
extern const RigEntry kSpreadingRig;
extern const RigEntry kShearCellRig;

}  // namespace talus::rigs
