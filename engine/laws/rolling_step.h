// How long a step the rolling dashpot (R3) and the rolling spring (R1) of EPSD bear.
//
// The dashpot answers to the spin of the half step before. Of the spin of two like grains against
// each other one contact takes in a step the share a, and its spring turns them back by the phase b
//
//   a = C_r Δt / I        b = √(k_r / I) Δt        1/I = 2/(0.4 m R²)    docs/physics.md, M6
//
// A grain in a bed has some five contacts. Where their dashpots take more than twice its spin
// together, or 5 b² comes near the 4 at which leapfrog diverges, they turn it round and wind it up:
// it chatters for ever, and bed and heap sink as if hardly anything resisted rolling.
#pragma once

#include "engine/laws/pair_constants.h"

namespace talus::engine {

// Beds came to rest up to 0.43 and never above 0.48 (docs/validation.md, Time step).
inline constexpr double kMostDampedShare = 0.36;
// Heaps were those of shorter steps up to 0.79, and lower from 0.80 on (the same page).
inline constexpr double kMostSpringPhase = 0.7;

// Like grains in a bed.
struct BedGrains {
  double radius = 0;   // R [m], > 0
  double density = 0;  // ρ [kg/m³], > 0
  double stress = 0;   // that presses them together, adhesion apart [Pa], >= 0; a goes with its
                       // sixth root, so that BedStress is near enough
};

// a [-] of a step of Δt [s].
double DampedShare(const PairConstants& pair, const BedGrains& grains, double dt);

// b [-] of a step of Δt [s].
double SpringPhase(const PairConstants& pair, const BedGrains& grains, double dt);

struct RollingLimit {
  double step = 0;         // Δt [s]; infinite where nothing resists rolling
  bool is_spring = false;  // what bounds it: the spring, or the dashpot
};

// The longest step, at which a is kMostDampedShare or b is kMostSpringPhase.
RollingLimit LongestRollingStep(const PairConstants& pair, const BedGrains& grains);

}  // namespace talus::engine
