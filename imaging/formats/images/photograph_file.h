// Photographs that are to be measured, in files.
//
// Measuring takes some 13 bytes a pixel and thread. Where a camera gives more than 25 million
// pixels, each pixel is the mean of a square of the file's: no heap is known better by more of
// them.
//
// A threshold between dark and light is half of the light only where levels are in proportion to
// it. Those of a picture that is coded for a display, as its EXIF says, are turned back: half-way
// of the coded ones a third of the light is there, and a blurred heap would lose up to 3 % of its
// area.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "imaging/gray_image.h"

namespace talus::imaging {

struct Photograph {
  GrayImage image;
  int width = 0;                        // of the file, upright [px]
  int height = 0;                       // [px]
  int block = 1;                        // side of the squares [px of the file]
  std::optional<std::int64_t> taken{};  // as in CameraImage [s]
};

// Throws ConfigError as ReadGrayImage does.
Photograph ReadPhotograph(const std::filesystem::path& path);

// Means of squares; what is left over at the right and lower edge is not shown.
GrayImage Reduced(const GrayImage& image, int block);

}  // namespace talus::imaging
