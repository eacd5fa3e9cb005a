// A case as text, and what tells two cases apart.
#pragma once

#include <cstdint>
#include <string>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// The case as a case.json that needs no other file.
std::string CaseText(const Case& rig_case);

// Whether both give the same grains, whatever is drawn or written of them.
bool IsSameRun(const Case& a, const Case& b);

// Identifies a case in a checkpoint and in result.json: what does not change the grains (threads,
// the checkpoint interval) is left out.
std::uint64_t CaseHash(const Case& rig_case);

}  // namespace talus::rigs
