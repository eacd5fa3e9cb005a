// The sides of a silhouette, and where both are straight and parallel.
#pragma once

#include <optional>
#include <vector>

#include "imaging/photos/backlight.h"

namespace talus::imaging {

// Where the largest dark area begins and ends in a row [px from the left edge of the image].
struct SideEnds {
  double left = 0;
  double right = 0;
};

// A row without it, or where it reaches the image's border, has none.
std::vector<std::optional<SideEnds>> FindSides(const BacklitPhoto& photo);

// Rows first … last whose ends lie on x = left + slope (y - first), y the row's centre, and the
// same for right.
struct StraightSides {
  int first = 0;
  int last = 0;
  double left = 0;   // [px], in row `first`
  double right = 0;  // [px]
  double slope = 0;  // dx/dy of both [-]

  double LeftAt(double row) const { return left + slope * (row - first); }
  double RightAt(double row) const { return right + slope * (row - first); }
  double width() const { return right - left; }  // along the row [px]
};

// The longest runs of rows with straight parallel sides, from the top.
std::vector<StraightSides> FindStraightSides(const std::vector<std::optional<SideEnds>>& sides);

}  // namespace talus::imaging
