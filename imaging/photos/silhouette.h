// The powder in a photograph, in the common frame: what projection.h makes of spheres.
#pragma once

#include "imaging/heap/profile.h"
#include "imaging/light/backlight.h"
#include "imaging/photos/ground.h"
#include "imaging/photos/plate/plate_fit.h"

namespace talus::imaging {

// Resampled so that the plate lies as `frame` has it, made binary (0 powder, 255 none), holes
// filled, and everything dropped that does not stand on the ground; on a table also what stands
// apart from the heap and is no grain. `photo_pixel` is the photograph's pixel size [m].
GrayImage MakeSilhouette(const BacklitPhoto& photo, const PlatePose& plate, double photo_pixel,
                         const Frame& frame, Ground ground);

// Whether the powder of such a silhouette reaches the photograph's left, right or upper border,
// which may lie within the frame.
bool ReachesBorder(const GrayImage& silhouette, const BacklitPhoto& photo, const PlatePose& plate,
                   double photo_pixel, const Frame& frame);

}  // namespace talus::imaging
