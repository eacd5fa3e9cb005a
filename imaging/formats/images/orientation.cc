#include "imaging/formats/images/orientation.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace talus::imaging {
namespace {

constexpr std::uint32_t kOrientationTag = 0x0112;
constexpr std::uint32_t kShortType = 3;
constexpr std::size_t kEntrySize = 12;  // tag 2, type 2, count 4, value 4 [bytes]

// Numbers of a TIFF structure, in its byte order; nothing behind its end.
class TiffBytes {
 public:
  explicit TiffBytes(std::string_view bytes)
      : bytes_(bytes), big_endian_(bytes.starts_with(std::string_view("MM\0*", 4))) {}

  bool valid() const { return big_endian_ || bytes_.starts_with(std::string_view("II*\0", 4)); }
  std::optional<std::uint32_t> Number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) return std::nullopt;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t byte = big_endian_ ? at + i : at + size - 1 - i;
      number = number << 8 | static_cast<std::uint8_t>(bytes_[byte]);
    }
    return number;
  }

 private:
  std::string_view bytes_;
  bool big_endian_;
};

}  // namespace

int ExifOrientation(std::string_view tiff) {
  const TiffBytes bytes(tiff);
  const auto directory = bytes.Number(4, 4);
  if (!bytes.valid() || !directory) return kUpright;
  const auto count = bytes.Number(*directory, 2);
  for (std::size_t i = 0; count && i < *count; ++i) {
    const std::size_t entry = *directory + 2 + i * kEntrySize;
    if (bytes.Number(entry, 2) != kOrientationTag) continue;
    const auto value = bytes.Number(entry + 8, 2);
    const bool known = bytes.Number(entry + 2, 2) == kShortType && value >= 1U && value <= 8U;
    return known ? static_cast<int>(*value) : kUpright;
  }
  return kUpright;
}

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
