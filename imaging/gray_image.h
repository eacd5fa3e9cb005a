// Our own image: 8-bit grey, so that no header carries a library's.
#pragma once

#include <cstdint>
#include <vector>

namespace talus::imaging {

struct GrayImage {
  int width = 0;                     // [px]
  int height = 0;                    // [px]
  std::vector<std::uint8_t> pixels;  // row by row from the top; 0 black … 255 white

  std::uint8_t& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  std::uint8_t at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  bool operator==(const GrayImage&) const = default;
};

}  // namespace talus::imaging
