// Where a table's top and the heap on it are, in a photograph without a plate.
//
// The table is dark like the powder and reaches across the lower border of the picture. Its top is
// the straight line that most columns' outline lies on; what stands above it and covers most is the
// heap.
#pragma once

#include <string>

#include "imaging/light/backlight.h"

namespace talus::imaging {

struct TableLine {
  double center_x = 0;  // of the heap's area, on the table's top [px] from the left edge
  double baseline = 0;  // the table's top there [px] from the top edge
  double tilt = 0;      // of the table's top [rad], > 0 if its right end is lower
  double reach = 0;     // farthest foot of the heap from its centre [px]
};

// Throws ConfigError that starts with `name` and says what to do when there is no such line or
// nothing stands on it.
TableLine FindTable(const BacklitPhoto& photo, const std::string& name);

}  // namespace talus::imaging
