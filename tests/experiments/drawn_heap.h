// What a drawn trial shows: heaps and numbers that follow the parameters and the seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/film_strip.h"

namespace talus::campaign {

inline constexpr double kTrueSliding = 0.45;
inline constexpr double kTrueRolling = 0.2;

inline imaging::Frame FakeFrame() {
  return {.width = 120,
          .height = 80,
          .pixel_size = 1e-4,
          .center_x = 60,
          .baseline = 76,
          .plate_diameter = 0.01};
}

// A cone whose slope follows μ_r, cut off at a height that follows μ_t; both scatter by the seed.
// `grown`: the share of its height that it has so far.
inline imaging::GrayImage DrawHeap(double sliding, double rolling, std::uint64_t seed,
                                   double grown = 1) {
  const imaging::Frame frame = FakeFrame();
  base::Random random(seed, base::Stream("fake heap"));
  const double slope = 0.2 + rolling + 0.01 * random.Normal();
  const double cap = 2 + 20 * sliding + 0.3 * random.Normal();
  imaging::GrayImage image{.width = frame.width, .height = frame.height, .pixels = {}};
  image.pixels.assign(static_cast<std::size_t>(frame.width * frame.height), 255);
  for (int x = 10; x < 110; ++x) {
    const double height = grown * std::min(cap, slope * (50 - std::abs(x + 0.5 - 60)));
    for (int y = 0; y < 76; ++y) {
      const double powder = std::clamp(height - (75 - y), 0.0, 1.0);
      image.at(x, y) = static_cast<std::uint8_t>(std::lround(255 * (1 - powder)));
    }
  }
  return image;
}

// A film of one heap: as it grows, or the same picture again and again.
inline imaging::GrayImage DrawFilm(double sliding, double rolling, std::uint64_t seed,
                                   int num_pictures, bool grows) {
  std::vector<imaging::GrayImage> pictures;
  for (int i = 1; i <= num_pictures; ++i) {
    pictures.push_back(
        DrawHeap(sliding, rolling, seed, grows ? static_cast<double>(i) / num_pictures : 1));
  }
  return imaging::SideBySide(pictures);
}

// [kg] that falls over the rim: less the more the grains rub.
inline double FallenMass(double sliding, double scatter, std::uint64_t seed) {
  base::Random random(seed, base::Stream("fake balance"));
  return 1e-6 * (50 - 60 * sliding) + scatter * random.Normal();
}

// [kg/m³] after taps: less the more the grains resist rolling.
inline double TappedDensity(double rolling, double scatter, std::uint64_t seed) {
  base::Random random(seed, base::Stream("fake taps"));
  return 1550 - 350 * rolling + scatter * random.Normal();
}

}  // namespace talus::campaign
