// How sharp a photograph shows the plate.
#pragma once

#include "imaging/light/backlight.h"
#include "imaging/photos/plate/side_lines.h"

namespace talus::imaging {

// Standard deviation of the Gaussian that blurs the plate's sides [px], from where their mean
// brightness passes a quarter and three quarters of the way from dark to light. About 0.4 for a
// sharp edge, whose pixels are as wide as that.
double EdgeBlur(const RelativeImage& image, const StraightSides& plate);

}  // namespace talus::imaging
