// Where a drum is in its photograph: the circle of its outermost edge.
//
// Rays from the picture's middle to its border meet the drum's ring where the level changes most
// for the first time from outside; a circle is fitted to these points, and points that lie off it
// (holders, reflections) drop out between rounds.
#pragma once

#include <string>

#include "imaging/gray_image.h"

namespace talus::imaging {

struct DrumCircle {
  double center_x = 0;  // [px] from the left edge of the photograph
  double center_y = 0;  // [px] from the top edge
  double radius = 0;    // [px]
};

// Throws ConfigError that starts with `name` and says what to do when there is no such circle.
DrumCircle FindDrumCircle(const GrayImage& photo, const std::string& name);

}  // namespace talus::imaging
