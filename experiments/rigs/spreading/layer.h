// A layer of powder as it is seen from above: how high it stands at each place, and what is bare.
//
// On a raster of a fifth of the mean diameter, h = the highest point of any grain at a pixel's
// centre, 0 where there is none:
//
//   coverage = share with h > 0      thickness = mean of h      roughness = standard deviation of h
#pragma once

#include <span>
#include <vector>

#include "engine/scene.h"
#include "imaging/gray_image.h"

namespace talus::rigs {

// The part of the plate that is looked at [m].
struct LayerWindow {
  double from = 0;  // along the path
  double to = 0;
  double half_width = 0;  // across, on either side of the middle

  bool Holds(const engine::Particle& grain) const;  // its centre
  double Area() const { return 2 * half_width * (to - from); }
};

// The highest point of any grain at each pixel's centre [m], 0 where there is none; row by row
// across, along the path in a row.
struct HeightMap {
  int along = 0;   // [px]
  int across = 0;  // [px]
  std::vector<double> heights;
};

// Grains beside the window reach into it.
HeightMap HeightMapOf(std::span<const engine::Particle> grains, const LayerWindow& window,
                      double pixel);

struct Layer {
  double coverage = 0;   // [-]
  double thickness = 0;  // [m]
  double roughness = 0;  // [m]
};

Layer LayerOf(const HeightMap& map);

// `mean_diameter` sets the raster [m].
Layer LayerOf(std::span<const engine::Particle> grains, const LayerWindow& window,
              double mean_diameter);

// Bare places white, the darker the higher, black from `highest` on [m].
imaging::GrayImage ImageOf(const HeightMap& map, double highest);

}  // namespace talus::rigs
