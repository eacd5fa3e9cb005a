// Uncompressed Windows bitmaps: 8 bits with a palette, 24 and 32 bits. Layout: BITMAPFILEHEADER of
// 14 bytes, then BITMAPINFOHEADER (40 bytes or a later, longer one) [bmp].
#include "base/error.h"
#include "imaging/formats/images/image_codecs.h"

namespace talus::imaging {
namespace {

class Bytes {
 public:
  Bytes(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::uint32_t Byte(std::size_t at) const {
    if (at >= bytes_.size()) ThrowDamaged(name_, "ends early");
    return static_cast<unsigned char>(bytes_[at]);
  }
  std::uint32_t Number(std::size_t at, int num_bytes) const {  // little-endian
    std::uint32_t value = 0;
    for (int i = num_bytes - 1; i >= 0; --i) {
      value = value << 8 | Byte(at + static_cast<std::size_t>(i));
    }
    return value;
  }

 private:
  std::string_view bytes_;
  const std::string& name_;
};

struct BmpLayout {
  std::size_t pixels = 0;   // offset of the first row
  std::size_t palette = 0;  // offset
  int width = 0;
  int height = 0;
  bool bottom_up = true;
  std::size_t bits = 0;  // a pixel
};

BmpLayout ReadLayout(const Bytes& bytes, std::size_t num_bytes, const std::string& name) {
  const auto signed_height = static_cast<std::int32_t>(bytes.Number(22, 4));
  const auto width = static_cast<std::int32_t>(bytes.Number(18, 4));
  const std::int64_t height = signed_height < 0 ? -std::int64_t{signed_height} : signed_height;
  CheckImageSize({.width = width, .height = height, .num_bytes = num_bytes}, name);
  const std::uint32_t header = bytes.Number(14, 4);
  const std::uint32_t bits = bytes.Number(28, 2);
  const std::uint32_t compression = bytes.Number(30, 4);
  const bool plain = compression == 0 || (compression == 3 && bits == 32);  // 3: masks, BGRA here
  if (header < 40 || !plain || (bits != 8 && bits != 24 && bits != 32)) {
    throw base::ConfigError(name +
                            ": is a compressed or unusual BMP; save it as PNG or as a plain 8-, "
                            "24- or 32-bit BMP");
  }
  return {.pixels = bytes.Number(10, 4),
          .palette = 14 + header,
          .width = width,
          .height = static_cast<int>(height),
          .bottom_up = signed_height > 0,
          .bits = bits};
}

}  // namespace

RawImage DecodeBmp(std::string_view data, const std::string& name) {
  const Bytes bytes(data, name);
  const BmpLayout layout = ReadLayout(bytes, data.size(), name);
  RawImage image{.width = layout.width, .height = layout.height, .channels = 3, .bits = 8};
  std::vector<std::uint16_t> samples;
  const std::size_t stride = (static_cast<std::size_t>(layout.width) * layout.bits + 31) / 32 * 4;
  for (int y = 0; y < layout.height; ++y) {
    const auto row = static_cast<std::size_t>(layout.bottom_up ? layout.height - 1 - y : y);
    samples.clear();
    for (int x = 0; x < layout.width; ++x) {
      std::size_t at =
          layout.pixels + row * stride + static_cast<std::size_t>(x) * (layout.bits / 8);
      if (layout.bits == 8) at = layout.palette + 4 * bytes.Byte(at);
      for (const std::size_t channel : {2, 1, 0}) {  // stored blue, green, red
        samples.push_back(static_cast<std::uint16_t>(bytes.Byte(at + channel)));
      }
    }
    image.AddRow(samples);
  }
  return image;
}

}  // namespace talus::imaging
