// Where in a photograph a pixel of a frame lies.
#pragma once

#include <array>
#include <cmath>

#include "imaging/heap/profile.h"
#include "imaging/photos/plate/plate_fit.h"

namespace talus::imaging {

// From pixel indices of the frame, whose pixels are `scale` of the photograph's wide, to pixel
// indices of the photograph: two rows of an affine map. OpenCV counts from pixel centres, hence the
// halves.
inline std::array<double, 6> PhotoFromFrame(const PlatePose& plate, double scale,
                                            const Frame& frame) {
  const double c = scale * std::cos(plate.tilt);
  const double s = scale * std::sin(plate.tilt);
  const double x = 0.5 - frame.center_x;
  const double y = 0.5 - frame.baseline;
  return {c, -s, plate.center_x + c * x - s * y - 0.5, s, c, plate.baseline + s * x + c * y - 0.5};
}

}  // namespace talus::imaging
