// Images in files: PNG, JPEG, TIFF, BMP and PGM in, PNG out.
//
// The codecs are used directly, not through OpenCV: its imgcodecs links some 140 libraries, and the
// program is started thousands of times in a campaign.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "imaging/color_image.h"
#include "imaging/gray_image.h"

namespace talus::imaging {

// Colour becomes luma (Rec. 601), transparency shows white, and 16 bits become 8; a 16-bit file
// that uses only 10, 12 or 14 of them, as cameras write, is taken to be that deep. The image is
// turned upright as its EXIF orientation says. Throws ConfigError that names the file and what to
// do.
GrayImage ReadGrayImage(const std::filesystem::path& path);

// The same from memory; `name` is what an error calls it.
GrayImage DecodeGrayImage(std::string_view bytes, const std::string& name);

std::string EncodePng(const GrayImage& image);
std::string EncodePng(const ColorImage& image);

// Written atomically; throws base::Error when that fails.
void WritePng(const std::filesystem::path& path, const GrayImage& image);
void WritePng(const std::filesystem::path& path, const ColorImage& image);

}  // namespace talus::imaging
