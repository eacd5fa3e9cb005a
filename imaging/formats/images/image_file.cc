#include "imaging/formats/images/image_file.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "imaging/formats/images/image_codecs.h"
#include "imaging/formats/images/orientation.h"

namespace talus::imaging {
namespace {

RawImage Decode(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\x89PNG")) return DecodePng(bytes, name);
  if (bytes.starts_with("\xff\xd8\xff")) return DecodeJpeg(bytes, name);
  if (bytes.starts_with(std::string_view("II*\0", 4)) ||
      bytes.starts_with(std::string_view("MM\0*", 4))) {
    return DecodeTiff(bytes, name);
  }
  if (bytes.starts_with("BM")) return DecodeBmp(bytes, name);
  if (bytes.starts_with("P5") || bytes.starts_with("P2")) return DecodePgm(bytes, name);
  throw base::ConfigError(name + ": " + (bytes.empty() ? "is empty" : "is no image we can read") +
                          "; give a PNG, JPEG, TIFF, BMP or PGM file");
}

// Of 16 bits: cameras store 10, 12 or 14 in them; the largest sample tells which.
double WhiteLevel(const RawImage& raw) {
  const std::uint16_t largest = *std::max_element(raw.samples.begin(), raw.samples.end());
  for (const int bits : {10, 12, 14}) {
    const int white = (1 << bits) - 1;
    if (largest > 255 && largest <= white) return white;
  }
  return 65535;
}

template <class Image>
void WriteAnyPng(const std::filesystem::path& path, const Image& image) {
  base::WriteFileAtomically(path, EncodePng(image));
}

}  // namespace

ColorImage ToColor(const GrayImage& gray) {
  ColorImage color{.width = gray.width, .height = gray.height, .pixels = {}};
  color.pixels.reserve(gray.pixels.size());
  for (const std::uint8_t level : gray.pixels) color.pixels.push_back({level, level, level});
  return color;
}

GrayImage DecodeGrayImage(std::string_view bytes, const std::string& name) {
  RawImage raw = Decode(bytes, name);
  GrayImage gray{.width = raw.width, .height = raw.height, .pixels = std::move(raw.gray)};
  if (raw.bits == 8) return Upright(gray, raw.orientation);
  const double white = WhiteLevel(raw);
  const auto channels = static_cast<std::size_t>(raw.channels);
  gray.pixels.resize(raw.samples.size() / channels);
  for (std::size_t i = 0; i < gray.pixels.size(); ++i) {
    gray.pixels[i] = GrayLevel(&raw.samples[i * channels], raw.channels, white);
  }
  return Upright(gray, raw.orientation);
}

GrayImage ReadGrayImage(const std::filesystem::path& path) {
  return DecodeGrayImage(base::ReadFile(path), path.string());
}

void WritePng(const std::filesystem::path& path, const GrayImage& image) {
  WriteAnyPng(path, image);
}
void WritePng(const std::filesystem::path& path, const ColorImage& image) {
  WriteAnyPng(path, image);
}

}  // namespace talus::imaging
