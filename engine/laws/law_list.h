// Which law struct stands for which name of the input. Everything that must know all laws — the
// kernels' table, the scalar evaluation, the tests — walks these rows.
#pragma once

#include "engine/laws/material.h"
#include "engine/laws/response.h"

namespace talus::engine {

template <class... Entries>
struct LawList {
  static constexpr int kSize = sizeof...(Entries);
};

// In the order of enum Rolling.
template <class Normal, class Friction>
using LawRow = LawList<Laws<Normal, Friction, NoRolling>, Laws<Normal, Friction, ConstantRolling>,
                       Laws<Normal, Friction, ViscousRolling>, Laws<Normal, Friction, EpsdRolling>,
                       Laws<Normal, Friction, Epsd2Rolling>>;

// In the order of enum Adhesion; then (T4), which knows no adhesion: every row costs the compiler a
// minute.
using LawRows =
    LawList<LawRow<NoAdhesion, TotalForceLimit>, LawRow<DmtAdhesion, TotalForceLimit>,
            LawRow<JkrAdhesion, TotalForceLimit>, LawRow<NoAdhesion, ElasticForceLimit>>;

inline constexpr int kNumLawRows = LawRows::kSize;
inline constexpr int kNumRollingLaws = LawRow<NoAdhesion, TotalForceLimit>::kSize;

constexpr int RowOf(const ContactModels& models) {
  const bool elastic = models.coulomb_limit == CoulombLimit::kElasticForce;
  return elastic ? kNumLawRows - 1 : static_cast<int>(models.adhesion);
}

}  // namespace talus::engine
