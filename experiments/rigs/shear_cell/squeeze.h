// How far the stress of a lid presses grains into each other, and how stiff their bed then is.
#pragma once

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Softer grains are pressed into dense order, in which they slide: at a share of 0.044 nearly equal
// grains lost two fifths of their friction, at 0.028 hardly any (docs/rigs.md).
inline constexpr double kMaxSqueeze = 0.04;

// Mean overlap over radius [-] under a stress [Pa] (engine/laws/pressed_bed.h).
double SqueezeShare(const Case& rig_case, double stress);

// Under which the share is kMaxSqueeze [Pa].
double BearableStress(const Case& rig_case);

// dσ/dε of the bed [Pa], its strain being δ/(2R).
double SqueezedModulus(const Case& rig_case, double stress);

}  // namespace talus::rigs
