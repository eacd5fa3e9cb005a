// A heap of spheres as a person would look at it: shaded grains on their plate.
//
// Parallel light and a camera far away. For figures only: silhouettes to measure are
// projection.h's.
#pragma once

#include <span>

#include "base/sphere.h"
#include "imaging/color_image.h"

namespace talus::imaging {

// Where the camera stands: it looks at the plate's centre, which is the origin, +z up.
struct Camera {
  int width = 640;            // [px]
  int height = 480;           // [px]
  double pixel_size = 0;      // [m], > 0
  double center_x = 0;        // of the plate [px] from the left edge
  double baseline = 0;        // the plate's centre [px] from the top edge
  double plate_diameter = 0;  // [m]; 0: no plate is drawn
  double azimuth = 0;         // turned about z [rad]
  double elevation = 0;       // above the horizontal [rad], in [0, π/2)
};

ColorImage RenderSpheres(std::span<const base::Sphere> spheres, const Camera& camera);

// Seen from the front, without a plate: all of one sphere or more in a picture so many pixels wide,
// and at most so many times as high.
Camera FromTheFront(std::span<const base::Sphere> spheres, int width, double most_height);

// Seen from somewhat above, the whole plate and heap in a picture so many pixels wide.
Camera WholeHeap(std::span<const base::Sphere> spheres, double plate_diameter, int width);

}  // namespace talus::imaging
