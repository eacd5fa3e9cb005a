// What a test's powder is filled into, and the scene with the powder in it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/filling.h"
#include "engine/scene/scene.h"
#include "experiments/rigs/lifted_tube/heap_case.h"

namespace talus::rigs {

// An upright tube or box.
struct Vessel {
  engine::FillRegion region;
  double area = 0;    // of its cross-section [m²]
  double across = 0;  // the diameter, or the shorter edge [m]
};

// `foot` is the centre of its floor; along x and y [m].
Vessel BoxVessel(const engine::Vec3& foot, double length, double width);

// Indices into the scene's materials.
inline constexpr int kPowder = 0;
inline constexpr int kWalls = 1;  // Device::tube_material
inline constexpr int kFloor = 2;  // Device::plate_material

std::vector<engine::Material> MaterialsOf(const HeapCase& heap_case);

// The powder's material with the coarse graining applied (docs/physics.md, C1).
engine::Material UsedMaterial(const HeapCase& heap_case);

struct FilledScene {
  engine::Scene scene;      // without walls
  engine::Filling filling;  // without the positions, which are in the scene
};

// At time 0; without grains where the powder is to be poured.
FilledScene FillVessel(const HeapCase& heap_case, const Vessel& vessel);

// Of the first grains of a filling, in their order [m³].
double FilledVolume(const HeapCase& heap_case, std::int64_t num_grains);

}  // namespace talus::rigs
