// The size of an image.
#pragma once

namespace talus::surrogate {

struct FieldSize {
  int width = 0;   // [px]
  int height = 0;  // [px]

  int num_pixels() const { return width * height; }
};

}  // namespace talus::surrogate
