// How far a stress presses grains into each other, and how stiff their bed then is.
//
// Under a stress σ a bed of solid fraction φ whose grains have Z contacts carries in each, on
// average [rumpf1958],
//
//   F = π d² σ/(φ Z)        with Hertz, F = (4/3) E* √(R/2) δ^(3/2):
//   δ/R = (3 √2 π σ/(φ Z E*))^(2/3)
//
// φ = 0.58 and Z = 4.5, as frictional grains have them that are sheared. The chains of contacts
// that carry most overlap three to four times as far.
#pragma once

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Softer grains are pressed into dense order, in which they slide: at a share of 0.044 nearly equal
// grains lost two fifths of their friction, at 0.028 hardly any (docs/rigs.md).
inline constexpr double kMaxSqueeze = 0.04;

// Mean overlap over radius [-] under a stress [Pa].
double SqueezeShare(const Case& rig_case, double stress);

// Under which the share is kMaxSqueeze [Pa].
double BearableStress(const Case& rig_case);

// dσ/dε of the bed [Pa], its strain being δ/(2R).
double SqueezedModulus(const Case& rig_case, double stress);

}  // namespace talus::rigs
