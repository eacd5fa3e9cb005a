// From spheres to silhouettes: what a camera far away would see of a simulated heap.
//
// The plate's centre is the origin, its top the plane z = 0, up is +z. View k of N looks along a
// horizontal direction turned by φ = π k / N about z (the other half of the circle shows mirror
// images):
//   column = center_x + (x cos φ + y sin φ) / pixel_size      row = baseline - z / pixel_size
// A pixel is powder when its centre lies in the disc of a sphere, rim included; what is below the
// baseline is never powder, nor is what lies outside the frame's disc.
#pragma once

#include <span>
#include <vector>

#include "base/sphere.h"
#include "imaging/heap/profile.h"

namespace talus::imaging {

inline constexpr int kMostViews = 1000;  // of one heap; more see nothing new

inline constexpr int kDefaultViews = 16;

// Two grains touch when the gap between them is at most this share of the smaller radius: enough
// for positions written with six digits, far below what opens a real gap.
inline constexpr double kTouchTolerance = 0.01;

// The spheres that reach the plate's top through touching neighbours, in their order; the others
// (in the air, on the floor, held by nothing) are not part of the heap.
std::vector<base::Sphere> GrainsOnPlate(std::span<const base::Sphere> spheres,
                                        double plate_diameter, double tolerance = kTouchTolerance);

// One silhouette a view, 0 = powder, 255 = none. Throws ConfigError when num_views < 1 or the frame
// is not valid.
std::vector<GrayImage> ProjectViews(std::span<const base::Sphere> spheres, const Frame& frame,
                                    int num_views);

// The mean of the views: an ANHP. All the spheres count: see GrainsOnPlate.
Profile ProjectHeap(std::span<const base::Sphere> spheres, const Frame& frame,
                    int num_views = kDefaultViews);

// The mean of silhouettes of one size, rounded to 8 bits; at least one.
GrayImage MeanImage(std::span<const GrayImage> images);

}  // namespace talus::imaging
