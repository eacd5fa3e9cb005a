// What is known of an output's noise before its process is fitted, at each scale factor.
#pragma once

#include <vector>

#include "optimizer/outputs/levels.h"
#include "surrogate/process/hyperparameters.h"

namespace talus::optimizer {

// The prior of one mode of images, 0 the strongest. `next_sd`: standard deviation of the strongest
// mode left out, at the coarsest scale factor (principal_modes.h); `spread`: of this mode's
// coefficients.
//
// What is left out is nearly all noise, and noise falls as 1/√k along the modes k = 1, 2, …: fresh
// heaps of 27 virtual powders scatter along mode k by 2.4/√k times next_sd on a plate of the tube's
// diameter and by 1.5/√k on a wide one, whether 11 or 180 heaps made the modes. The prior is on
// their large side, and narrow at the finest scale factor, since a process with a free noise takes
// it for too small, and the region with it (docs/validation.md).
std::vector<surrogate::LogNormal> NoiseOfMode(const Levels& levels, int mode, double next_sd,
                                              double spread);

// The prior of a number that a test measures.
std::vector<surrogate::LogNormal> NoiseOfScalar(const Levels& levels);

}  // namespace talus::optimizer
