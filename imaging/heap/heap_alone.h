// The heap of an image without the grains beside it, which are no part of its outline.
#pragma once

#include "imaging/heap/profile.h"

namespace talus::imaging {

// The image with white for what is not connected with the heap: the largest thing on a plate; on a
// table, where larger things may stand, what is nearest to its middle. A pixel is connected with
// its eight neighbours where both show powder in any view.
GrayImage HeapAlone(const GrayImage& image, const Frame& frame);

}  // namespace talus::imaging
