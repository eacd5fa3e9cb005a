// Drawn photographs of a drum, and what is measured on them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>

#include "imaging/drums/drum.h"
#include "imaging/formats/images/image_file.h"
#include "tests/error_in.h"

namespace talus::imaging::drum_test {

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kSide = 300;          // of the picture [px]
constexpr double kCenterX = 152.3;  // of the drum [px]
constexpr double kCenterY = 147.6;
constexpr double kRadius = 140;

// A drum lit from behind, with a dark ring, before a wall that is neither; its powder lies below a
// plane that is `depth` radii below the axis and falls to the right by `angle`.
struct Drawn {
  double angle = 0;    // [rad]
  double depth = 0.2;  // [-]
};

inline double Level(const Drawn& drawn, double x, double y) {
  const double right = x - kCenterX, up = kCenterY - y;
  const double r = std::hypot(right, up);
  if (r > kRadius) return 170;
  if (r > kRadius - 4) return 15;
  const double above = up * std::cos(drawn.angle) + right * std::sin(drawn.angle);
  return above < -drawn.depth * kRadius ? 25 : 240;
}

// Each pixel is the mean of 4 × 4 points, as a camera's is.
inline GrayImage Draw(const Drawn& drawn) {
  GrayImage image{.width = kSide, .height = kSide, .pixels = {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      double sum = 0;
      for (int i = 0; i < 16; ++i) {
        sum += Level(drawn, x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4);
      }
      image.pixels.push_back(static_cast<std::uint8_t>(sum / 16 + 0.5));
    }
  }
  return image;
}

inline fs::path Write(const std::string& name, const GrayImage& image) {
  const fs::path file = fs::path(testing::TempDir()) / ("drum_" + name + ".png");
  WritePng(file, image);
  return file;
}

inline std::string ErrorOf(const DrumPhotos& options) {
  return ErrorIn([&] { MeasureDrum(options); });
}

inline MeasuredDrum Measure(const Drawn& drawn) {
  return MeasureDrum({.photos = {Write("one", Draw(drawn))}, .diameter = 0.084});
}

inline GrayImage Inverse(GrayImage photo) {
  for (std::uint8_t& level : photo.pixels) level = static_cast<std::uint8_t>(255 - level);
  return photo;
}

}  // namespace talus::imaging::drum_test
