#include "imaging/formats/images/image_file.h"

#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "imaging/formats/images/image_codecs.h"
#include "imaging/formats/images/orientation.h"

namespace talus::imaging {
namespace {

RawImage Decode(std::string_view bytes, const std::string& name, double white) {
  if (bytes.starts_with("\x89PNG")) return DecodePng(bytes, name, white);
  if (bytes.starts_with("\xff\xd8\xff")) return DecodeJpeg(bytes, name);
  if (bytes.starts_with(std::string_view("II*\0", 4)) ||
      bytes.starts_with(std::string_view("MM\0*", 4))) {
    return DecodeTiff(bytes, name, white);
  }
  if (bytes.starts_with("BM")) return DecodeBmp(bytes, name);
  if (bytes.starts_with("P5") || bytes.starts_with("P2")) return DecodePgm(bytes, name, white);
  throw base::ConfigError(name + ": " + (bytes.empty() ? "is empty" : "is no image we can read") +
                          "; give a PNG, JPEG, TIFF, BMP or PGM file");
}

// Cameras store 10, 12 or 14 bits in 16, and programs 8; the largest sample tells which.
double WhiteOf(std::uint16_t largest) {
  for (const int bits : {8, 10, 12, 14}) {
    const int white = (1 << bits) - 1;
    if (largest <= white) return white;
  }
  return 65535;
}

CameraImage DecodeCamera(std::string_view bytes, const std::string& name) {
  RawImage raw = Decode(bytes, name, 0);
  if (raw.bits == 16 && raw.white == 0) raw = Decode(bytes, name, WhiteOf(raw.largest));
  return {
      .image = Upright({.width = raw.width, .height = raw.height, .pixels = std::move(raw.gray)},
                       raw.orientation),
      .taken = raw.taken,
      .is_for_display = raw.is_for_display};
}

template <class Image>
void WriteAnyPng(const std::filesystem::path& path, const Image& image) {
  base::WriteFileAtomically(path, EncodePng(image));
}

}  // namespace

GrayImage DecodeGrayImage(std::string_view bytes, const std::string& name) {
  return DecodeCamera(bytes, name).image;
}

CameraImage ReadCameraImage(const std::filesystem::path& path) {
  return DecodeCamera(base::ReadFile(path), path.string());
}

GrayImage ReadGrayImage(const std::filesystem::path& path) { return ReadCameraImage(path).image; }

void WritePng(const std::filesystem::path& path, const GrayImage& image) {
  WriteAnyPng(path, image);
}
void WritePng(const std::filesystem::path& path, const ColorImage& image) {
  WriteAnyPng(path, image);
}

}  // namespace talus::imaging
