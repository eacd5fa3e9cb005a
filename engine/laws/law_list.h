// Which law struct stands for which name of the input. Everything that must know all laws — the
// kernels' table, the scalar evaluation, the tests — walks these two lists.
#pragma once

#include <cstddef>

#include "engine/laws/material.h"
#include "engine/laws/response.h"

namespace talus::engine {

template <class... Laws>
struct LawList {
  static constexpr int kSize = sizeof...(Laws);
};

// In the order of enum Adhesion and enum Rolling.
using NormalLaws = LawList<NoAdhesion, DmtAdhesion, JkrAdhesion>;
using RollingLaws = LawList<NoRolling, ConstantRolling, ViscousRolling, EpsdRolling, Epsd2Rolling>;

inline constexpr int kNumNormalLaws = NormalLaws::kSize;
inline constexpr int kNumRollingLaws = RollingLaws::kSize;

}  // namespace talus::engine
