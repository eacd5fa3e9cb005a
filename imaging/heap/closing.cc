#include "imaging/heap/closing.h"

#include <algorithm>

namespace talus::imaging {
namespace {

template <class Better>
GrayImage AlongRows(const GrayImage& image, int reach, Better better) {
  GrayImage best = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int last = std::min(image.width - 1, x + reach);
      for (int u = std::max(0, x - reach); u <= last; ++u) {
        best.at(x, y) = better(best.at(x, y), image.at(u, y));
      }
    }
  }
  return best;
}

GrayImage Transposed(const GrayImage& image) {
  GrayImage turned{.width = image.height, .height = image.width, .pixels = image.pixels};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) turned.at(y, x) = image.at(x, y);
  }
  return turned;
}

template <class Better>
GrayImage Extreme(const GrayImage& image, int reach, Better better) {
  return Transposed(AlongRows(Transposed(AlongRows(image, reach, better)), reach, better));
}

}  // namespace

GrayImage Closed(const GrayImage& image, int reach) {
  const auto darker = [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); };
  const auto lighter = [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); };
  return Extreme(Extreme(image, reach, darker), reach, lighter);
}

}  // namespace talus::imaging
