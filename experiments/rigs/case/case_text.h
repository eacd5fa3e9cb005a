// A case as text, and what tells two cases apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// The case as a case.json that needs no other file.
std::string CaseText(const Case& rig_case);

// What makes the grains of the two differ, whatever is drawn or written of them: "powder.mass is
// 0.001 there and 0.002 here"; nothing where both give the same. Sizes that differ by a factor give
// the same at scale factors that differ by it.
std::optional<std::string> RunDifference(const Case& there, const Case& here);

// Whether both give the same grains.
inline bool IsSameRun(const Case& a, const Case& b) { return !RunDifference(a, b); }

// The same text for cases that differ in what does not change the grains: threads, the checkpoint
// interval.
std::string RunText(const Case& rig_case);

// Identifies a case in a checkpoint and in result.json: of its RunText.
std::uint64_t CaseHash(const Case& rig_case);

}  // namespace talus::rigs
