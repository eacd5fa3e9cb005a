// The scene of a heap test at time 0: tube and plate, and the powder filled into the tube.
#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/lifted_tube/heap_case.h"
#include "experiments/rigs/vessel.h"

namespace talus::rigs {

// Indices into the scene's walls.
inline constexpr int kTube = 0;
inline constexpr int kPlate = 1;

Vessel TubeOf(const HeapCase& heap_case);

// The plate's top is z = 0; the tube stands on it, empty where the powder is to be poured.
FilledScene MakeHeapScene(const HeapCase& heap_case);

// What a user should know before trusting the result of any rig, a sentence each; none when all is
// well.
std::vector<std::string> HeapWarnings(const HeapCase& heap_case);

}  // namespace talus::rigs
