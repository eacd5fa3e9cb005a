// A film as an animated GIF, which every browser and viewer plays.
//
// Version 89a with LZW compression (CompuServe, 1990). All frames share one palette of the 256
// colours that most pixels have; others become the nearest of these.
#pragma once

#include <span>
#include <string>

#include "imaging/color_image.h"

namespace talus::imaging {

// Plays for ever, each frame for so long [s], to the next hundredth. All frames are of one size.
std::string EncodeGif(std::span<const ColorImage> frames, double frame_time);

}  // namespace talus::imaging
