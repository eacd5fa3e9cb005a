// What one photograph shows of the plate: points on its edges, to a fraction of a pixel.
//
// The plate is the widest part of the silhouette with two straight parallel sides; of several about
// as wide the lowest. Its lower edge is seen where the pedestal is narrower. Its top shows where no
// powder covers it, and where coarse grains let light through between themselves and the plate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imaging/light/backlight.h"

namespace talus::imaging {

struct EdgePoint {
  double x = 0;  // [px] from the left edge of the image
  double y = 0;  // [px] from the top edge
};

// Where a side of the plate ends at the top.
struct PlateCorner {
  EdgePoint point;
  bool sharp = false;  // cut out by the side and a straight outline next to it; else to about 1 px
};

struct PlateEdges {
  double width = 0;  // between the sides [px]
  double tilt = 0;   // of the sides [rad], > 0 if the plate's right end is lower
  std::vector<EdgePoint> left;
  std::vector<EdgePoint> right;
  std::vector<EdgePoint> lower;  // empty when the plate reaches the image's lower edge
  PlateCorner top_left;
  PlateCorner top_right;
  std::optional<EdgePoint> seam;  // on the plate's top, found by the light under the lowest grains
};

// Throws ConfigError that starts with `name` and says what to do when there is no plate.
PlateEdges FindPlateEdges(const BacklitPhoto& photo, const std::string& name);

}  // namespace talus::imaging
