// The scene of a heap test at time 0: tube and plate, and the powder filled into the tube.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/filling.h"
#include "engine/scene/scene.h"
#include "experiments/rigs/lifted_tube/heap_case.h"

namespace talus::rigs {

// Indices into the scene's walls.
inline constexpr int kTube = 0;
inline constexpr int kPlate = 1;

struct HeapScene {
  engine::Scene scene;
  engine::Filling filling;  // without the positions, which are in the scene
};

// The plate's top is z = 0; the tube stands on it, empty where the powder is to be poured.
HeapScene MakeHeapScene(const HeapCase& heap_case);

// The powder's material with the coarse graining applied (docs/physics.md, C1).
engine::Material UsedMaterial(const HeapCase& heap_case);

// What a user should know before trusting the result, a sentence each; none when all is well.
std::vector<std::string> HeapWarnings(const HeapCase& heap_case);

// Of the first grains of a filling, in their order [m³].
double FilledVolume(const HeapCase& heap_case, std::int64_t num_grains);

}  // namespace talus::rigs
