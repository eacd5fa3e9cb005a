// How a camera was held, as EXIF tells it, and the image turned upright.
//
// Cameras store the sensor's rows and a tag with the turn (tag 0x0112):
//
//   1 upright              3 half a turn            6 clockwise quarter      8 counter-clockwise
//   2 mirrored left-right  4 mirrored top-bottom    5, 7 mirrored and turned
//
// The quarter of 6 and 8 is the turn that makes the stored image upright.
#pragma once

#include "imaging/gray_image.h"

namespace talus::imaging {

inline constexpr int kUpright = 1;

GrayImage Upright(GrayImage stored, int orientation);

}  // namespace talus::imaging
