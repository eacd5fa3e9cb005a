// Grey maps of the Netpbm family: P5 (bytes, or big-endian 16 bit above 255) and P2 (decimal text)
// [netpbm].
#include <cctype>

#include "base/error.h"
#include "imaging/formats/images/image_codecs.h"

namespace talus::imaging {
namespace {

class Cursor {
 public:
  Cursor(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  // The next decimal number, after white space and # comments.
  int Number() {
    SkipBlanks();
    if (at_ >= bytes_.size() || std::isdigit(Peek()) == 0)
      ThrowDamaged(name_, "a number is missing");
    std::int64_t value = 0;
    while (at_ < bytes_.size() && std::isdigit(Peek()) != 0) {
      value = 10 * value + (Peek() - '0');
      if (value > 1'000'000) ThrowDamaged(name_, "a number is too large");
      ++at_;
    }
    return static_cast<int>(value);
  }
  int Byte() {
    if (at_ >= bytes_.size()) ThrowDamaged(name_, "ends early");
    return static_cast<unsigned char>(bytes_[at_++]);
  }

 private:
  int Peek() const { return static_cast<unsigned char>(bytes_[at_]); }
  void SkipBlanks() {
    while (at_ < bytes_.size() && (std::isspace(Peek()) != 0 || Peek() == '#')) {
      if (Peek() == '#') {
        while (at_ < bytes_.size() && Peek() != '\n') ++at_;
      } else {
        ++at_;
      }
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 2;  // after the two letters of the kind
};

}  // namespace

RawImage DecodePgm(std::string_view bytes, const std::string& name, double white) {
  const bool is_text = bytes.starts_with("P2");
  Cursor cursor(bytes, name);
  RawImage image{.white = white};
  image.width = cursor.Number();
  image.height = cursor.Number();
  const int most = cursor.Number();
  CheckImageSize({.width = image.width, .height = image.height, .num_bytes = bytes.size()}, name);
  if (most < 1 || most > 65535) ThrowDamaged(name, "its white is not from 1 to 65535");
  image.bits = most > 255 ? 16 : 8;
  // A white below that of 16 bits is stated by whoever knows the camera.
  if (most > 255 && most < 65535) image.white = 65535;
  const std::int64_t full = most > 255 ? 65535 : 255;
  if (!is_text) cursor.Byte();  // the one blank after the header
  std::vector<std::uint16_t> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    for (std::uint16_t& pixel : row) {
      int sample = is_text ? cursor.Number() : cursor.Byte();
      if (!is_text && most > 255) sample = sample << 8 | cursor.Byte();
      if (sample > most) ThrowDamaged(name, "a pixel is brighter than white");
      pixel = static_cast<std::uint16_t>((sample * full + most / 2) / most);
    }
    image.AddRow(row);
  }
  return image;
}

}  // namespace talus::imaging
