// Backlit photographs drawn by a test: a heap on a plate on a pedestal, sampled 4 × 4 times a
// pixel, tilted, blurred, under uneven light, with noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "base/random.h"
#include "base/sphere.h"
#include "imaging/gray_image.h"

namespace talus::imaging {

struct Scene {
  int width = 640;           // [px]
  int height = 480;          // [px]
  double plate_width = 300;  // [px]
  double plate_depth = 40;   // thickness [px]
  double pedestal = 0.54;    // its width / the plate's [-]
  double center_x = 320;     // of the plate's top [px]
  double baseline = 380;     // [px]
  double tilt = 0;           // [rad], > 0 if the right end is lower
  double blur = 1.2;         // standard deviation [px]
  double noise = 3;          // standard deviation [grey levels]
  double darkness = 0.1;     // of powder and plate, over the light
  bool uneven = true;        // else the light is the same everywhere
  std::uint64_t seed = 1;
};

inline constexpr int kSamples = 4;  // a pixel and direction

// Whether a point is dark, `along` the plate from its middle and `up` from its top [px].
using Dark = std::function<bool(double along, double up)>;

inline bool OnPlateOrPedestal(const Scene& scene, double along, double up) {
  if (up > 0) return false;
  return std::abs(along) <
         (up > -scene.plate_depth ? 0.5 : 0.5 * scene.pedestal) * scene.plate_width;
}

// Share of each pixel that is dark.
inline std::vector<double> Cover(const Scene& scene, const Dark& dark) {
  std::vector<double> cover;
  const double c = std::cos(scene.tilt);
  const double s = std::sin(scene.tilt);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      int count = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const double dx = x + (k % kSamples + 0.5) / kSamples - scene.center_x;
        const double dy = y + (k / kSamples + 0.5) / kSamples - scene.baseline;
        const double along = dx * c + dy * s;
        const double up = dx * s - dy * c;
        count += OnPlateOrPedestal(scene, along, up) || dark(along, up);
      }
      cover.push_back(count / static_cast<double>(kSamples * kSamples));
    }
  }
  return cover;
}

// One direction of a Gaussian blur; `stride` 1 along rows, `length` pixels in a line.
inline void BlurLines(std::vector<double>& image, std::size_t stride, std::size_t length,
                      std::size_t line_step, std::size_t lines, double sigma) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> kernel;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) kernel.push_back(std::exp(-k * k / (2 * sigma * sigma)));
  for (const double weight : kernel) sum += weight;
  std::vector<double> line(length);
  for (std::size_t i = 0; i < lines; ++i) {
    for (std::size_t j = 0; j < length; ++j) line[j] = image[i * line_step + j * stride];
    for (std::size_t j = 0; j < length; ++j) {
      double value = 0;
      for (int k = -reach; k <= reach; ++k) {
        const auto at = std::clamp(static_cast<int>(j) + k, 0, static_cast<int>(length) - 1);
        value += kernel[static_cast<std::size_t>(k + reach)] * line[static_cast<std::size_t>(at)];
      }
      image[i * line_step + j * stride] = value / sum;
    }
  }
}

inline GrayImage Expose(const Scene& scene, std::vector<double> cover) {
  const auto width = static_cast<std::size_t>(scene.width);
  const auto height = static_cast<std::size_t>(scene.height);
  if (scene.blur > 0) {
    BlurLines(cover, 1, width, width, height, scene.blur);
    BlurLines(cover, width, height, 1, width, scene.blur);
  }
  base::Random random(scene.seed, base::Stream("synthetic photo"));
  GrayImage photo{.width = scene.width, .height = scene.height, .pixels = {}};
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const double x = static_cast<double>(i % width) / scene.width - 0.45;
    const double y = static_cast<double>(i / width) / scene.height - 0.4;
    const double light = scene.uneven ? 225 * (1 - 0.9 * x * x - 0.7 * y * y + 0.15 * x) : 215;
    const double value = light * (1 - (1 - scene.darkness) * cover[i]);
    photo.pixels.push_back(static_cast<std::uint8_t>(
        std::clamp(value + scene.noise * random.Normal(), 0.0, 255.0) + 0.5));
  }
  return photo;
}

// A heap drawn by its height over the plate, h(along) [px].
inline GrayImage PhotographOf(const Scene& scene, const std::function<double(double)>& height) {
  return Expose(
      scene, Cover(scene, [&](double along, double up) { return up > 0 && up < height(along); }));
}

// Spheres seen along a horizontal direction turned by `angle`; the plate is `plate_diameter` wide.
inline GrayImage PhotographOf(const Scene& scene, std::span<const base::Sphere> spheres,
                              double plate_diameter, double angle) {
  const double scale = scene.plate_width / plate_diameter;  // [px/m]
  const int columns = scene.width * kSamples;
  std::vector<bool> dark(static_cast<std::size_t>(columns * scene.height * kSamples));
  for (const base::Sphere& sphere : spheres) {
    const auto& p = sphere.position;
    const double along = scale * (p.x * std::cos(angle) + p.y * std::sin(angle));
    const double up = scale * p.z;
    const double x = scene.center_x + along * std::cos(scene.tilt) + up * std::sin(scene.tilt);
    const double y = scene.baseline + along * std::sin(scene.tilt) - up * std::cos(scene.tilt);
    const double radius = scale * sphere.radius;
    for (int j = static_cast<int>((y - radius) * kSamples); j <= (y + radius) * kSamples; ++j) {
      for (int i = static_cast<int>((x - radius) * kSamples); i <= (x + radius) * kSamples; ++i) {
        const double dx = (i + 0.5) / kSamples - x;
        const double dy = (j + 0.5) / kSamples - y;
        const bool inside = dx * dx + dy * dy <= radius * radius;
        if (inside) dark[static_cast<std::size_t>(j * columns + i)] = true;
      }
    }
  }
  std::vector<double> cover = Cover(scene, [](double, double) { return false; });
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      int count = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        count += dark[static_cast<std::size_t>((y * kSamples + k / kSamples) * columns +
                                               x * kSamples + k % kSamples)];
      }
      double& share = cover[static_cast<std::size_t>(y * scene.width + x)];
      share = std::max(share, count / static_cast<double>(kSamples * kSamples));
    }
  }
  return Expose(scene, std::move(cover));
}

}  // namespace talus::imaging
