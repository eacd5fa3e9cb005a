// What a drum's silhouette says: fill, the powder's surface and its dynamic angle.
//
// The angle is that of the least-squares line through the surface in the middle half of the bed,
// between the quarters of what lies from 2 to 98 % of the powder: as the rig `drum` measures
// spheres. A speck above the bed is no surface of it. The fill is that of the whole disc: a flat
// surface bounds the same segment of it as of what is seen within the ring. Powder that turns with
// the drum has neither.
#pragma once

#include <vector>

#include "imaging/drums/drum_circle.h"
#include "imaging/gray_image.h"
#include "imaging/heap/measured.h"

namespace talus::imaging {

// A map of how often a pixel is powder: 0 always, 255 never. What lies farther out than the inner
// radius is not known, and 255.
struct DrumMap {
  GrayImage image;
  DrumCircle circle;        // the outermost
  double drum_radius = 0;   // of the drum inside [px], at most the circle's
  double inner_radius = 0;  // within it the ring hides nothing [px], below the drum's
};

struct DrumPoint {
  double x = 0;       // right of the axis [px]
  double height = 0;  // above the axis [px]
};

struct DrumSurface {
  std::vector<DrumPoint> points;  // at half the views, column by column
  Measured slope_angle;           // [rad], > 0 where the powder is higher on the left
  Measured fill;                  // share of the whole drum's disc, from what is seen of it [-]
};

DrumSurface MeasureSurface(const DrumMap& map);

}  // namespace talus::imaging
