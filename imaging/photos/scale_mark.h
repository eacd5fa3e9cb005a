// A length that is known in the photographs: two points, such as two marks of a ruler, and the
// distance between them. It takes the plate's place as scale where there is no plate.
#pragma once

#include <string>

namespace talus::imaging {

struct ScaleMark {
  double x1 = 0;  // [px] from the left edge of the photograph
  double y1 = 0;  // [px] from the top edge
  double x2 = 0;
  double y2 = 0;
  double length = 0;  // [m], > 0

  double pixel_size() const;  // [m]
};

// "104,310-884,312 = 30 mm". Throws ConfigError that says how it is written.
ScaleMark ParseScale(const std::string& text);

}  // namespace talus::imaging
