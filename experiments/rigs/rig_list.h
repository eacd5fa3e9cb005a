// The rigs there are (rig_list.cc).
#pragma once

#include <memory>
#include <string>

#include "experiments/rigs/case/case.h"
#include "experiments/rigs/phased/rig_entry.h"

namespace talus::rigs {

const RigEntry& EntryOf(const Case& rig_case);

// Fills it.
std::unique_ptr<Rig> MakeRig(const Case& rig_case);

// Goes on from a checkpoint of the same case.
std::unique_ptr<Rig> RestoreRig(const Case& rig_case, const std::string& state,
                                engine::Simulation simulation);

}  // namespace talus::rigs
