// The rigs there are: one entry each (rig_list.cc).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/rigs/lifted_tube/heap_case.h"
#include "experiments/rigs/rig.h"
#include "experiments/rigs/vessel.h"

namespace talus::rigs {

struct RigEntry {
  RigKind kind;
  std::unique_ptr<Rig> (*make)(const HeapCase&);
  std::unique_ptr<Rig> (*restore)(const HeapCase&, const std::string& state, engine::Simulation);
  Vessel (*vessel)(const HeapCase&);         // that the powder is filled into
  std::span<const char* const> observables;  // their names, with units
  // What the rig's own options cannot see by themselves.
  void (*validate)(const HeapCase&, base::Problems&);
  double (*width)(const HeapCase&);  // that its images are scaled by: of plate, drum or box [m]
  // Simulated, beside filling and coming to rest, of powder that is filled to a height [s].
  double (*test_time)(const HeapCase&, double filled_height);
};

const RigEntry& EntryOf(const HeapCase& heap_case);

// Of its image, over 180°: one from the front where the test has one.
int NumViewsOf(const HeapCase& heap_case);

// Fills it.
std::unique_ptr<Rig> MakeRig(const HeapCase& heap_case);

// Goes on from a checkpoint of the same case.
std::unique_ptr<Rig> RestoreRig(const HeapCase& heap_case, const std::string& state,
                                engine::Simulation simulation);

}  // namespace talus::rigs
