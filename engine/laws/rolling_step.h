// How long a step the rolling dashpot of EPSD bears (R3).
//
// It answers to the spin of the half step before. Of the spin of two like grains against each other
// one contact takes in a step the share
//
//   a = C_r Δt / I        1/I = 2/(0.4 m R²)                             docs/physics.md, M6
//
// A grain in a bed has some five contacts. Where they take more than twice its spin together, they
// turn it round and wind it up: it chatters for ever, and bed and heap sink as if hardly anything
// resisted rolling.
#pragma once

#include "engine/laws/pair_constants.h"

namespace talus::engine {

// Beds came to rest up to 0.43 and never above 0.48 (docs/validation.md, Time step).
inline constexpr double kMostDampedShare = 0.36;

// Like grains in a bed.
struct BedGrains {
  double radius = 0;   // R [m], > 0
  double density = 0;  // ρ [kg/m³], > 0
  double stress = 0;   // that presses them together, adhesion apart [Pa], >= 0; a goes with its
                       // sixth root, so that BedStress is near enough
};

// a [-] of a step of Δt [s].
double DampedShare(const PairConstants& pair, const BedGrains& grains, double dt);

// Δt [s] at which a is kMostDampedShare; infinite where nothing damps.
double LongestRollingStep(const PairConstants& pair, const BedGrains& grains);

}  // namespace talus::engine
