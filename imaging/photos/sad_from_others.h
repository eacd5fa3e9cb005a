// How far heaps of one powder are from each other.
#pragma once

#include <vector>

#include "imaging/gray_image.h"

namespace talus::imaging {

// SAD of each image from the mean of the others [px]; two images or more, of one size.
std::vector<double> SadFromOthers(const std::vector<GrayImage>& images);

}  // namespace talus::imaging
