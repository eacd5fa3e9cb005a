// How long a step the dashpots and springs of a bed's contacts bear (docs/physics.md, M6 and M7).
//
// A dashpot answers to the velocity of the half step before. Of the spin of two like grains, of
// rolling against each other, of sliding both the same way, one contact takes in a step the share
// a, and its spring turns them back by the phase b
//
//   rolling, EPSD (R1, R3)   a = C_r Δt / I          b = √(k_r / I) Δt       1/I = 2/(0.4 m R²)
//   sliding (N1, N4)         a = 5 η_t Δt / m        b = √(5 k_t / m) Δt     5/m = 2 R²/(0.4 m R²)
//
// A grain in a bed has some five contacts. Where their dashpots take more than twice its spin
// together, or 5 b² comes near the 4 at which leapfrog diverges, they turn it round and wind it up:
// it chatters for ever, and bed and heap sink as if hardly anything resisted.
#pragma once

#include "engine/laws/material.h"
#include "engine/laws/pair_constants.h"

namespace talus::engine {

// Beds came to rest up to 0.43 and never above 0.48 (docs/validation.md, Time step).
inline constexpr double kMostDampedShare = 0.36;
// Heaps were those of shorter steps up to 0.79, and lower from 0.80 on (the same page).
inline constexpr double kMostSpringPhase = 0.7;
// Beds were as high as with shorter steps up to 1.2, lower by 0.7 % at 1.4 (the same page).
inline constexpr double kMostSlidingLoad = 1.1;

// Like grains in a bed.
struct BedGrains {
  double radius = 0;   // R [m], > 0
  double density = 0;  // ρ [kg/m³], > 0
  double stress = 0;   // that presses them together, adhesion apart [Pa], >= 0; a goes with its
                       // sixth root, so that BedStress is near enough
};

// a of rolling [-] in a step of Δt [s].
double DampedShare(const PairConstants& pair, const BedGrains& grains, double dt);

// b of rolling [-] in a step of Δt [s].
double SpringPhase(const PairConstants& pair, const BedGrains& grains, double dt);

// 2 a + b² of sliding [-] in a step of Δt [s]: what leapfrog with a dashpot that lags has to keep
// below 4 for a single contact.
double SlidingLoad(const PairConstants& pair, const BedGrains& grains, double dt);

enum class StepBound { kRollingDashpot, kRollingSpring, kSlidingDashpot };

struct StepLimit {
  double step = 0;                               // Δt [s]
  StepBound bound = StepBound::kSlidingDashpot;  // what allows no longer one
};

// The longest step at which none of the three exceeds its bound; those of rolling count with EPSD
// alone. Infinite where neither friction nor rolling resistance acts.
StepLimit LongestStep(const PairConstants& pair, const BedGrains& grains, Rolling rolling);

}  // namespace talus::engine
