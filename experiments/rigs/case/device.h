// The key `device` of a case and of an experiment: the tube and the plate of the lifted tube, and
// what the walls and the floor of any rig are made of.
#pragma once

#include <optional>
#include <string_view>

#include "base/problems.h"
#include "experiments/rigs/options/lifted_tube_options.h"
#include "experiments/rigs/options/rig_options.h"
#include "experiments/rigs/options/wall_material.h"

namespace talus::rigs {

struct Device : LiftedTubeOptions {
  std::optional<WallMaterial> tube_material{};   // the walls of other rigs
  std::optional<WallMaterial> plate_material{};  // their floor

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    LiftedTubeOptions::Visit(self, visit);
    visit("tube_material", self.tube_material, {.doc = "where it differs from the powder's"});
    visit("plate_material", self.plate_material, {.doc = "where it differs from the powder's"});
  }
};

// Without tube and plate, as other rigs than the lifted tube take it.
Device MaterialsOf(const Device& device);

// A tube or plate that is stated for another rig than the lifted tube is an error.
void RequireNoTube(RigKind kind, const LiftedTubeOptions& stated, std::string_view path,
                   base::Problems& problems);

}  // namespace talus::rigs
