// What was found in a photograph, drawn over it: the powder's outline, the plate, the baseline.
#pragma once

#include "imaging/color_image.h"
#include "imaging/light/backlight.h"
#include "imaging/photos/experiment.h"

namespace talus::imaging {

// `silhouette` is of `frame`; small photographs are enlarged so that a pixel's error shows. Red:
// the powder's outline; blue: the plate's sides; green: the baseline, and the plate's middle.
ColorImage DrawOverlay(const GrayImage& photo, const PlatePose& plate, const GrayImage& silhouette,
                       const Frame& frame);

// A photograph that cannot be used, which is read again: the outline of all that is dark enough
// (red), and the plate's sides where some were found (blue).
ColorImage FaultOf(const UnusablePhoto& unusable, const ExperimentOptions& options);

// The overlay of one measured photograph, which is read again.
ColorImage OverlayOf(const MeasuredView& view, const Frame& frame, const ExperimentOptions& options,
                     double photo_pixel);

// A photograph resampled so that its plate lies as `frame` has it: pixel for pixel beside profiles
// of that frame. `photo_pixel` is the photograph's pixel size [m].
GrayImage PhotoInFrame(const GrayImage& photo, const PlatePose& plate, double photo_pixel,
                       const Frame& frame);

}  // namespace talus::imaging
