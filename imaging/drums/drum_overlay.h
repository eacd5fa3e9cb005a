// What was found in a photograph of a drum, drawn over it.
#pragma once

#include "imaging/color_image.h"
#include "imaging/drums/drum.h"

namespace talus::imaging {

// The circle (blue), what counts of it (green), and the powder's surface (red); small photographs
// are enlarged.
ColorImage DrawDrum(const GrayImage& photo, const MeasuredDrum& drum);

}  // namespace talus::imaging
