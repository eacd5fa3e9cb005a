#include "imaging/formats/images/orientation.h"

#include <cstddef>

namespace talus::imaging {

GrayImage Upright(GrayImage stored, int orientation) {
  if (orientation <= kUpright || orientation > 8) return stored;
  const bool turned = orientation >= 5;  // rows become columns
  const bool from_right = orientation == 2 || orientation == 3 || orientation >= 7;
  const bool from_bottom =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  GrayImage image{.width = turned ? stored.height : stored.width,
                  .height = turned ? stored.width : stored.height,
                  .pixels = {}};
  image.pixels.reserve(stored.pixels.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int column = turned ? y : x;
      const int row = turned ? x : y;
      const int x_stored = from_right ? stored.width - 1 - column : column;
      const int y_stored = from_bottom ? stored.height - 1 - row : row;
      image.pixels.push_back(stored.pixels[static_cast<std::size_t>(y_stored) *
                                               static_cast<std::size_t>(stored.width) +
                                           static_cast<std::size_t>(x_stored)]);
    }
  }
  return image;
}

}  // namespace talus::imaging
