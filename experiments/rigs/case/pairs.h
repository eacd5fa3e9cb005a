// The pairs of a case: what the powder and the plate, the powder and the tube, or two grains state
// themselves, in place of what follows from the two materials (docs/physics.md, P8).
//
// `between` names bodies as the keys of `device` do: "plate" is the floor of other rigs, and "tube"
// their walls.
#pragma once

#include <optional>
#include <vector>

#include "base/problems.h"
#include "engine/laws/material_pair.h"
#include "engine/scene/pair_spec.h"
#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// "powder", "tube", "plate", by the index of their material (materials.h).
inline constexpr const char* kBodyNames[] = {"powder", "tube", "plate"};

// The body that grains touch in this pair, by its index: kPowder where that is the powder itself.
// Nothing for a pair that names no body, or not the powder.
std::optional<int> PartnerOf(const engine::PairSpec& pair);

// Names that are no body, pairs without the powder, pairs given twice.
void ValidatePairs(const std::vector<engine::PairSpec>& pairs, base::Problems& problems);

// What the powder and a body state; nothing where the list has no such pair.
engine::PairProperties StatedWith(const std::vector<engine::PairSpec>& pairs, int body);

// The same to be written; the pair is added where it is missing.
engine::PairProperties& PairWith(std::vector<engine::PairSpec>& pairs, int body);

// The pairs of the case's scene, the surface energy coarse-grained as the powder's (C1).
std::vector<engine::MaterialPair> PairsOf(const Case& rig_case);

}  // namespace talus::rigs
