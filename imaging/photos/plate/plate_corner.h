// The upper corners of the plate, where a side ends and the plate's top begins.
#pragma once

#include "imaging/photos/plate/plate_edges.h"
#include "imaging/photos/plate/tilted_view.h"

namespace talus::imaging {

struct SideEnd {
  EdgePoint point;         // where the side leaves its line, some pixels off the corner
  int side = -1;           // -1 left, +1 right
  double blur = 1;         // EdgeBlur [px]
  double plate_width = 0;  // [px]
};

PlateCorner FindCorner(const TiltedView& tilted, const SideEnd& end);

}  // namespace talus::imaging
