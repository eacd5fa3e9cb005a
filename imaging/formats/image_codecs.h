// What each file format decodes to, before it becomes 8-bit grey.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/formats/orientation.h"

namespace talus::imaging {

// Samples of 8 bits are 0 … 255, of 16 bits 0 … 65535.
struct RawImage {
  int width = 0;
  int height = 0;
  int channels = 1;            // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int bits = 8;                // 8 or 16
  int orientation = kUpright;  // how the camera was held, as EXIF numbers it
  std::vector<std::uint16_t> samples;

  std::size_t num_samples() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(channels);
  }
};

// Each throws ConfigError that starts with `name` when the bytes are damaged or of a kind it does
// not read.
RawImage DecodePng(std::string_view bytes, const std::string& name);
RawImage DecodeJpeg(std::string_view bytes, const std::string& name);
RawImage DecodeTiff(std::string_view bytes, const std::string& name);
RawImage DecodeBmp(std::string_view bytes, const std::string& name);
RawImage DecodePgm(std::string_view bytes, const std::string& name);

// Throws ConfigError unless both sides are 1 … 65500 and the area is at most 200 Mpx: a damaged
// header must not ask for all memory.
void CheckImageSize(std::int64_t width, std::int64_t height, const std::string& name);

[[noreturn]] void ThrowDamaged(const std::string& name, const std::string& reason);

}  // namespace talus::imaging
