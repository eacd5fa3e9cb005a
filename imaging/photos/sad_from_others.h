// How far heaps of one powder are from each other.
#pragma once

#include <vector>

#include "imaging/gray_image.h"

namespace talus::imaging {

// Of each of two images or more, of one size, its SAD from the mean of the others [px].
std::vector<double> SadFromOthers(const std::vector<GrayImage>& images);

}  // namespace talus::imaging
