// The rigs there are: one entry each (rig_list.cc).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/rigs/case/case.h"
#include "experiments/rigs/filling/vessel.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/phased/rig.h"

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
  // Simulated, beside filling and coming to rest, of powder that is filled to a height [s].
  double (*test_time)(const Case&, double filled_height);
};

const RigEntry& EntryOf(const Case& rig_case);

// Fills it.
std::unique_ptr<Rig> MakeRig(const Case& rig_case);

// Goes on from a checkpoint of the same case.
std::unique_ptr<Rig> RestoreRig(const Case& rig_case, const std::string& state,
                                engine::Simulation simulation);

}  // namespace talus::rigs
