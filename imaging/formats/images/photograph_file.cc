#include "imaging/formats/images/photograph_file.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "imaging/formats/images/image_codecs.h"

namespace talus::imaging {
namespace {

constexpr double kMostPixels = 25e6;

int BlockFor(const GrayImage& image) {
  return static_cast<int>(std::ceil(std::sqrt(image.pixels.size() / kMostPixels)));
}

// The curve of sRGB (IEC 61966-2-1), turned back.
void MakeLinear(GrayImage& image) {
  std::array<std::uint8_t, 256> light{};
  for (std::size_t level = 0; level < light.size(); ++level) {
    const double v = static_cast<double>(level) / 255;
    const double share = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    light[level] = static_cast<std::uint8_t>(std::lround(255 * share));
  }
  for (std::uint8_t& pixel : image.pixels) pixel = light[pixel];
}

}  // namespace

GrayImage Reduced(const GrayImage& image, int block) {
  GrayImage small{.width = image.width / block, .height = image.height / block, .pixels = {}};
  small.pixels.reserve(static_cast<std::size_t>(small.width) *
                       static_cast<std::size_t>(small.height));
  const int area = block * block;
  for (int y = 0; y < small.height; ++y) {
    std::vector<int> sums(static_cast<std::size_t>(small.width));
    for (int row = y * block; row < (y + 1) * block; ++row) {
      for (int x = 0; x < small.width * block; ++x) {
        sums[static_cast<std::size_t>(x / block)] += image.at(x, row);
      }
    }
    for (const int sum : sums) {
      small.pixels.push_back(static_cast<std::uint8_t>((sum + area / 2) / area));
    }
  }
  return small;
}

Photograph ReadPhotograph(const std::filesystem::path& path) {
  CameraImage read = ReadCameraImage(path);
  if (read.is_for_display) MakeLinear(read.image);
  Photograph photo{.image = std::move(read.image), .taken = read.taken};
  photo.width = photo.image.width;
  photo.height = photo.image.height;
  photo.block = BlockFor(photo.image);
  if (photo.block > 1) photo.image = Reduced(photo.image, photo.block);
  return photo;
}

}  // namespace talus::imaging
