// A layer of powder as it is seen from above: how high it stands at each place, and what is bare.
//
// On a raster of a fifth of the mean diameter, h = the highest point of any grain at a pixel's
// centre, 0 where there is none:
//
//   coverage = share with h > 0      thickness = mean of h      roughness = standard deviation of h
#pragma once

#include <span>

#include "engine/scene.h"

namespace talus::rigs {

// The part of the plate that is looked at [m].
struct LayerWindow {
  double from = 0;  // along the path
  double to = 0;
  double half_width = 0;  // across, on either side of the middle

  bool Holds(const engine::Particle& grain) const;  // its centre
  double Area() const { return 2 * half_width * (to - from); }
};

struct Layer {
  double coverage = 0;   // [-]
  double thickness = 0;  // [m]
  double roughness = 0;  // [m]
};

// `mean_diameter` sets the raster [m]; grains beside the window reach into it.
Layer LayerOf(std::span<const engine::Particle> grains, const LayerWindow& window,
              double mean_diameter);

}  // namespace talus::rigs
