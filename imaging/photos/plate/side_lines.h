// The sides of a silhouette, and where both are straight and parallel.
#pragma once

#include <optional>
#include <vector>

#include "imaging/light/backlight.h"

namespace talus::imaging {

// Where the largest dark area begins and ends in a row [px from the left edge of the image]. A row
// without it, or where it reaches the image's border, has none.
struct SideEnds {
  double left = 0;
  double right = 0;
};

inline constexpr int kTrimmed = 2;  // rows at the ends of a side that the lens has rounded

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
  int num_rows() const { return last + 1 - first; }
};

// The sides of the plate: of the straight parallel ones about as wide as the widest, the lowest, or
// those that this one carries as a pedestal.
struct PlateSides {
  std::vector<std::optional<SideEnds>> ends;  // in every row of the photograph
  StraightSides straight;
  bool is_cut = false;   // the pedestal's: the plate above reaches the image's left or right border
  double left_top = 0;   // where the sides leave their lines for good, seen from the plate upwards
  double right_top = 0;  // [px] from the top edge of the image
};

// Nothing where no straight parallel sides are thick enough for a plate's.
std::optional<PlateSides> FindPlateSides(const BacklitPhoto& photo);

}  // namespace talus::imaging
