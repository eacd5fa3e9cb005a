#include "experiments/rigs/case/device.h"

namespace talus::rigs {

Device MaterialsOf(const Device& device) {
  Device materials;
  materials.tube_material = device.tube_material;
  materials.plate_material = device.plate_material;
  return materials;
}

void RequireNoTube(RigKind kind, const LiftedTubeOptions& stated, std::string_view path,
                   base::Problems& problems) {
  problems.Require(kind == RigKind::kLiftedTube || stated == LiftedTubeOptions{}, path,
                   "states a tube or a plate, which only the lifted tube has: leave all out but "
                   "tube_material and plate_material, and state lengths under rig");
}

}  // namespace talus::rigs
