#include "imaging/formats/images/photograph_file.h"

#include <algorithm>
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
double LightOf(double level) {
  const double v = level / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// The highest level that a thousandth of the pixels have or exceed: not that of a hot pixel.
std::size_t WhiteOf(const GrayImage& image) {
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t pixel : image.pixels) ++count[pixel];
  std::size_t white = 255;
  for (std::size_t brighter = count[white]; 1000 * brighter < image.pixels.size() && white > 0;) {
    brighter += count[--white];
  }
  return white;
}

// White stays as bright as it is: of a dim photograph's levels few would be left.
void MakeLinear(GrayImage& image) {
  const std::size_t white = WhiteOf(image);
  if (white == 0) return;
  const double gain = static_cast<double>(white) / LightOf(static_cast<double>(white));
  std::array<std::uint8_t, 256> light{};
  for (std::size_t level = 0; level < light.size(); ++level) {
    const double linear = gain * LightOf(static_cast<double>(level));
    light[level] = static_cast<std::uint8_t>(std::lround(std::min(255.0, linear)));
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
