#include "experiments/rigs/spreading/layer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace talus::rigs {
namespace {

constexpr double kPixel = 0.2;  // mean diameters

// Pixels whose centres lie in [low, high].
struct PixelRange {
  int first = 0;
  int last = -1;
};

PixelRange PixelsIn(double low, double high, double pixel, int count) {
  return {.first = std::max(0, static_cast<int>(std::ceil(low / pixel - 0.5))),
          .last = std::min(count - 1, static_cast<int>(std::floor(high / pixel - 0.5)))};
}

}  // namespace

bool LayerWindow::Holds(const engine::Particle& grain) const {
  return grain.position.x >= from && grain.position.x < to &&
         std::abs(grain.position.y) < half_width;
}

HeightMap HeightMapOf(std::span<const engine::Particle> grains, const LayerWindow& window,
                      double pixel) {
  HeightMap map;
  map.along = std::max(1, static_cast<int>((window.to - window.from) / pixel));
  map.across = std::max(1, static_cast<int>(2 * window.half_width / pixel));
  map.heights.resize(static_cast<std::size_t>(map.along) * static_cast<std::size_t>(map.across));
  for (const engine::Particle& p : grains) {
    const double x = p.position.x - window.from;
    const double y = p.position.y + window.half_width;
    const PixelRange columns = PixelsIn(x - p.radius, x + p.radius, pixel, map.along);
    const PixelRange rows = PixelsIn(y - p.radius, y + p.radius, pixel, map.across);
    for (int j = rows.first; j <= rows.last; ++j) {
      for (int i = columns.first; i <= columns.last; ++i) {
        const double dx = (i + 0.5) * pixel - x;
        const double dy = (j + 0.5) * pixel - y;
        const double square = p.radius * p.radius - dx * dx - dy * dy;
        if (square < 0) continue;
        double& h = map.heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(map.along) +
                                static_cast<std::size_t>(i)];
        h = std::max(h, p.position.z + std::sqrt(square));
      }
    }
  }
  return map;
}

Layer LayerOf(const HeightMap& map) {
  Layer layer;
  const auto count = static_cast<double>(map.heights.size());
  for (const double h : map.heights) {
    layer.coverage += h > 0 ? 1 / count : 0;
    layer.thickness += h / count;
  }
  for (const double h : map.heights) {
    layer.roughness += (h - layer.thickness) * (h - layer.thickness) / count;
  }
  layer.roughness = std::sqrt(layer.roughness);
  return layer;
}

Layer LayerOf(std::span<const engine::Particle> grains, const LayerWindow& window,
              double mean_diameter) {
  return LayerOf(HeightMapOf(grains, window, kPixel * mean_diameter));
}

imaging::GrayImage ImageOf(const HeightMap& map, double highest) {
  constexpr double kLightest = 210;  // of powder, so that a bare place stands out
  imaging::GrayImage image{.width = map.along, .height = map.across, .pixels = {}};
  image.pixels.reserve(map.heights.size());
  for (const double h : map.heights) {
    const double level = h > 0 ? kLightest * (1 - std::min(1.0, h / highest)) : 255;
    image.pixels.push_back(static_cast<std::uint8_t>(level + 0.5));
  }
  return image;
}

}  // namespace talus::rigs
