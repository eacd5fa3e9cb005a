// A drawn photograph of a turning drum of 84 mm.
#pragma once

#include <cmath>
#include <numbers>

#include "imaging/gray_image.h"

namespace talus::campaign {

inline constexpr int kDrumSide = 200;  // of the picture [px]
inline constexpr double kDrumRadius = 95;
inline constexpr double kDrumRing = 3;  // [px]

// Half full; the surface falls by so many degrees to the right, or to the left. Up to `haze` [px]
// above it half of the pictures show powder.
inline imaging::GrayImage DrawDrum(bool falls_right, double haze = 0, double degrees = 40) {
  imaging::GrayImage image{.width = kDrumSide, .height = kDrumSide, .pixels = {}};
  const double slope = std::tan(degrees * std::numbers::pi / 180) * (falls_right ? -1 : 1);
  for (int y = 0; y < kDrumSide; ++y) {
    for (int x = 0; x < kDrumSide; ++x) {
      const double right = x + 0.5 - kDrumSide / 2.0;
      const double up = kDrumSide / 2.0 - y - 0.5;
      const double r = std::hypot(right, up);
      const bool dark = (r <= kDrumRadius && up < slope * right) ||
                        (r <= kDrumRadius && r > kDrumRadius - kDrumRing);
      const bool half = r <= kDrumRadius && up < slope * right + haze;
      image.pixels.push_back(dark ? 20 : half ? 130 : 240);
    }
  }
  return image;
}

}  // namespace talus::campaign
