// What a heap test leaves behind in result.json: how each phase ended, what lies on the plate, what
// it cost, and the conditions that calibrated values hold for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "experiments/rigs/lifted_tube/heap_case.h"
#include "experiments/rigs/lifted_tube/heap_rig.h"

namespace talus::rigs {

// The grains that a chain of contacts connects with the plate or that are about to land on these or
// on it, by id.
std::vector<engine::Particle> GrainsOfHeap(const engine::Simulation& simulation);

// The content of result.json after the test has ended.
std::string HeapResultText(const HeapCase& heap_case, const HeapRig& rig,
                           const std::vector<engine::Particle>& heap,
                           const engine::RunTiming& timing);

// The state as one line of a checkpoint, and back.
std::string HeapStateLine(const HeapState& state);
HeapState ParseHeapState(const std::string& line);

// Identifies a case in a checkpoint and in result.json: what does not change the heap (threads, the
// checkpoint interval) is left out.
std::uint64_t HeapCaseHash(const HeapCase& heap_case);

}  // namespace talus::rigs
