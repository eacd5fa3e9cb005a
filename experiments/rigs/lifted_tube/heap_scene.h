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

// Fewer grains across the plate of a heap that decides are worth a warning: in `validate`, a
// trial's result and a campaign's alarms. Coarser ones that only guide a search are not.
inline constexpr double kAdvisedAcross = 30;
double GrainsAcrossPlate(const HeapCase& heap_case);
// "only 25 grains across the plate PLATE at their true size: …", and what would help.
std::string FewGrainsText(double across, double scale_factor, const std::string& plate);

// What a user should know before trusting the result of any rig, a sentence each; none when all is
// well.
std::vector<std::string> HeapWarnings(const HeapCase& heap_case);
// The same but for the number of grains.
std::vector<std::string> SetUpWarnings(const HeapCase& heap_case);

}  // namespace talus::rigs
