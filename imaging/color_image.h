// A colour picture, for drawings and renderings; photographs are measured in grey.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "imaging/gray_image.h"

namespace talus::imaging {

using Color = std::array<std::uint8_t, 3>;  // red, green, blue

struct ColorImage {
  int width = 0;              // [px]
  int height = 0;             // [px]
  std::vector<Color> pixels;  // row by row from the top

  Color& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

inline ColorImage ToColor(const GrayImage& gray) {
  ColorImage color{.width = gray.width, .height = gray.height, .pixels = {}};
  color.pixels.reserve(gray.pixels.size());
  for (const std::uint8_t level : gray.pixels) color.pixels.push_back({level, level, level});
  return color;
}

}  // namespace talus::imaging
