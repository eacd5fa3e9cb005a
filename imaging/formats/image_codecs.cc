#include "imaging/formats/image_codecs.h"

#include "base/error.h"

namespace talus::imaging {

void CheckImageSize(std::int64_t width, std::int64_t height, const std::string& name) {
  constexpr std::int64_t kLongest = 65500;
  constexpr std::int64_t kLargest = 200'000'000;
  if (width >= 1 && height >= 1 && width <= kLongest && height <= kLongest &&
      width * height <= kLargest) {
    return;
  }
  throw base::ConfigError(name + ": has " + std::to_string(width) + " x " + std::to_string(height) +
                          " px; give an image of at least one and at most 200 million pixels");
}

void ThrowDamaged(const std::string& name, const std::string& reason) {
  throw base::ConfigError(name + ": the image is damaged (" + reason +
                          "); copy it from the camera again or leave it out");
}

}  // namespace talus::imaging
