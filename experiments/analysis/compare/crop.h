// Pictures cut to where the heaps are: most of a profile's image is empty.
#pragma once

#include <vector>

#include "imaging/gray_image.h"
#include "imaging/heap/profile.h"

namespace talus::analysis {

struct Box {
  int left = 0;  // [px]
  int top = 0;
  int width = 0;
  int height = 0;
};

// Round the powder of all the profiles and the plate, with a margin; all of one frame. A film's is
// as wide as its strip.
Box HeapBox(const std::vector<const imaging::Profile*>& profiles);

imaging::GrayImage Cropped(const imaging::GrayImage& image, const Box& box);

}  // namespace talus::analysis
