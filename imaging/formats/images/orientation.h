// How a camera was held, as EXIF tells it, and the image turned upright.
//
// Cameras store the sensor's rows and a tag with the turn (tag 0x0112):
//
//   1 upright              3 half a turn            6 clockwise quarter      8 counter-clockwise
//   2 mirrored left-right  4 mirrored top-bottom    5, 7 mirrored and turned
//
// The quarter of 6 and 8 is the turn that makes the stored image upright.
#pragma once

#include <string_view>

#include "imaging/gray_image.h"

namespace talus::imaging {

inline constexpr int kUpright = 1;

// From a TIFF structure, as APP1 of a JPEG and eXIf of a PNG hold one; kUpright where it has no
// such tag or is damaged: a photograph is not lost to its description.
int ExifOrientation(std::string_view tiff);

GrayImage Upright(GrayImage stored, int orientation);

}  // namespace talus::imaging
