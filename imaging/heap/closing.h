// Closing of a silhouette: gaps between powder narrower than a width are filled, edges stay.
#pragma once

#include "imaging/gray_image.h"

namespace talus::imaging {

// The darkest, then the lightest of the squares of 2 `reach` + 1 pixels. Pixels outside the image
// have no say.
GrayImage Closed(const GrayImage& image, int reach);

}  // namespace talus::imaging
