#include "experiments/rigs/lifted_tube/heap_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/scene/scene_warnings.h"
#include "experiments/rigs/lifted_tube/pouring.h"

namespace talus::rigs {
namespace {

std::vector<engine::Wall> Walls(const HeapCase& c, double default_tube_length) {
  const double plate_radius = c.device.plate_diameter / 2;
  engine::WallShape plate = engine::Disc{.center = {}, .radius = plate_radius};
  if (c.device.plate == PlateKind::kSolidCylinder) {
    plate = engine::SolidCylinder{.base = {0, 0, -c.device.plate_height},
                                  .radius = plate_radius,
                                  .length = c.device.plate_height};
  }
  const engine::OpenCylinder tube{.base = {},
                                  .radius = c.device.tube_inner_diameter / 2,
                                  .length = c.device.tube_length.value_or(default_tube_length)};
  return {{.name = "tube", .shape = tube, .material = 1, .motion = {}},
          {.name = "plate", .shape = plate, .material = 2, .motion = {}}};
}

}  // namespace

Vessel TubeOf(const HeapCase& c) {
  const double diameter = c.device.tube_inner_diameter;
  return {.region = {.diameter = diameter},
          .area = std::numbers::pi / 4 * std::pow(diameter, 2),
          .across = diameter};
}

FilledScene MakeHeapScene(const HeapCase& c) {
  const Vessel tube = TubeOf(c);
  FilledScene made = FillVessel(c, tube);
  made.scene.walls = Walls(
      c, c.filling.kind == FillingKind::kDense ? 1.1 * made.filling.height : PouredHeight(c, tube));
  return made;
}

std::vector<std::string> HeapWarnings(const HeapCase& c) {
  std::vector<std::string> warnings;
  const double across = c.device.plate_diameter / EstimateHeap(c).mean_diameter;
  std::ostringstream text;
  text.precision(3);
  const bool has_plate = KindOf(c) == RigKind::kLiftedTube;
  if (has_plate && across < 15) {
    text << "COARSE: only " << across
         << " grains across the plate: the heap is a pile of boulders, and its shape says little "
            "of the powder; lower the scale factor (30 or more are advised)";
  } else if (has_plate && across < 30) {
    text << "only " << across << " grains across the plate; 30 or more are advised";
  }
  if (has_plate && across < 30) warnings.push_back(text.str());
  if (c.rayleigh_fraction > kHeapRayleighFraction) {
    warnings.push_back("rayleigh_fraction is above 0.3: heaps have been compared up to there only");
  }
  for (std::string& warning : engine::AdhesionWarnings(c.models, MaterialsOf(c))) {
    warnings.push_back(std::move(warning));
  }
  if (c.models.rolling == engine::Rolling::kConstant && c.rayleigh_fraction > 0.15) {
    warnings.push_back(
        "constant rolling resistance creeps in proportion to the time step: set rayleigh_fraction "
        "to 0.15 or less");
  }
  return warnings;
}

}  // namespace talus::rigs
