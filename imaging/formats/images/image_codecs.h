// What each file format decodes to, before it becomes 8-bit grey.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/formats/images/orientation.h"
#include "imaging/gray_image.h"

namespace talus::imaging {

// Filled row by row from the top, so that a header that promises more than the file holds takes no
// memory. Rows of 8 bits become grey at once. Those of 16 do where their white is known; else only
// the largest sample is kept, which says how many of the bits the camera has used, and
// the file is read again: samples would take up to eight times the image's memory.
struct RawImage {
  int width = 0;
  int height = 0;
  int channels = 1;                     // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int bits = 8;                         // 8 or 16
  int orientation = kUpright;           // how the camera was held, as EXIF numbers it
  std::optional<std::int64_t> taken{};  // ExifTime
  bool is_for_display = false;          // ExifIsForDisplay
  double white = 0;                     // sample of 16 bits that is white; 0: not known
  std::uint16_t largest = 0;            // sample of 16 bits that is not alpha
  std::vector<std::uint8_t> gray{};     // empty where white is not known

  // Samples of 8 bits are 0 … 255, of 16 bits 0 … 65535.
  void AddRow(std::span<const std::uint16_t> row);
  void Reserve();  // for all rows: growing would take three times their memory
};

// Grey is luma (Rec. 601), transparency on white. Each throws ConfigError that starts with `name`
// when the bytes are damaged or of a kind it does not read. `white` is RawImage::white.
RawImage DecodePng(std::string_view bytes, const std::string& name, double white);
RawImage DecodeTiff(std::string_view bytes, const std::string& name, double white);
RawImage DecodePgm(std::string_view bytes, const std::string& name, double white);
RawImage DecodeJpeg(std::string_view bytes, const std::string& name);
RawImage DecodeBmp(std::string_view bytes, const std::string& name);

// A file of any of these formats as ReadGrayImage has it, with what JPEG and PNG may say of it:
// when it was taken by the camera's clock [s], and whether its levels are coded for a display.
struct CameraImage {
  GrayImage image;
  std::optional<std::int64_t> taken{};
  bool is_for_display = false;
};
CameraImage ReadCameraImage(const std::filesystem::path& path);

struct ImageSize {
  std::int64_t width = 0;     // [px]
  std::int64_t height = 0;    // [px]
  std::size_t num_bytes = 0;  // of the file
};

// Throws ConfigError unless both sides are 1 … 65500, the area is at most 200 Mpx, and the file's
// bytes can hold that many pixels: a damaged header must not ask for all memory.
void CheckImageSize(const ImageSize& size, const std::string& name);

[[noreturn]] void ThrowDamaged(const std::string& name, const std::string& reason);

}  // namespace talus::imaging
