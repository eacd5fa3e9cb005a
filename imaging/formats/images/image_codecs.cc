#include "imaging/formats/images/image_codecs.h"

#include <algorithm>

#include "base/error.h"

namespace talus::imaging {
namespace {

bool HasAlpha(int channels) { return channels % 2 == 0; }

// What one pixel's samples are at their most.
struct Full {
  double white = 255;
  double alpha = 255;  // of all the sample's bits, however many of them the camera has
};

// Samples of one pixel as a grey level, 0 … 255.
std::uint8_t GrayLevel(const std::uint16_t* s, int channels, const Full& full) {
  const bool color = channels >= 3;
  const double white = full.white;
  double luma = color ? (0.299 * s[0] + 0.587 * s[1] + 0.114 * s[2]) / white : s[0] / white;
  if (HasAlpha(channels)) {
    const double alpha = s[channels - 1] / full.alpha;
    luma = luma * alpha + 1 - alpha;
  }
  return static_cast<std::uint8_t>(std::clamp(luma, 0.0, 1.0) * 255 + 0.5);
}

}  // namespace

void RawImage::AddRow(std::span<const std::uint16_t> row) {
  const auto stride = static_cast<std::size_t>(channels);
  if (bits == 16 && white == 0) {
    const std::size_t num_levels = HasAlpha(channels) ? stride - 1 : stride;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i % stride < num_levels) largest = std::max(largest, row[i]);
    }
    return;
  }
  Reserve();
  const Full full = bits == 8 ? Full{} : Full{.white = white, .alpha = 65535};
  for (std::size_t i = 0; i < row.size(); i += stride) {
    gray.push_back(GrayLevel(&row[i], channels, full));
  }
}

// Pages that are never written take no memory.
void RawImage::Reserve() {
  gray.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

void CheckImageSize(const ImageSize& size, const std::string& name) {
  constexpr std::int64_t kLongest = 65500;
  constexpr std::int64_t kLargest = 200'000'000;
  // White of 1 bit a pixel, deflated 1032 to 1, and some more.
  constexpr std::int64_t kMostOfOneByte = 9000;
  const auto [width, height, num_bytes] = size;
  const std::string pixels = std::to_string(width) + " x " + std::to_string(height) + " px";
  if (!(width >= 1 && height >= 1 && width <= kLongest && height <= kLongest &&
        width * height <= kLargest)) {
    throw base::ConfigError(name + ": has " + pixels +
                            "; give an image of at least one and at most 200 million pixels");
  }
  if (width * height / kMostOfOneByte > static_cast<std::int64_t>(num_bytes)) {
    ThrowDamaged(name, "it says that it has " + pixels + ", which do not fit into its " +
                           std::to_string(num_bytes) + " bytes");
  }
}

void ThrowDamaged(const std::string& name, const std::string& reason) {
  throw base::ConfigError(name + ": the image is damaged (" + reason +
                          "); copy it from the camera again or leave it out");
}

}  // namespace talus::imaging
