#include "experiments/rigs/spreading/layer.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

Layer LayerOf(std::span<const engine::Particle> grains, const LayerWindow& window,
              double mean_diameter) {
  const double pixel = kPixel * mean_diameter;
  const int along = std::max(1, static_cast<int>((window.to - window.from) / pixel));
  const int across = std::max(1, static_cast<int>(2 * window.half_width / pixel));
  std::vector<double> height(static_cast<std::size_t>(along) * static_cast<std::size_t>(across));
  for (const engine::Particle& p : grains) {
    const double x = p.position.x - window.from;
    const double y = p.position.y + window.half_width;
    const PixelRange columns = PixelsIn(x - p.radius, x + p.radius, pixel, along);
    const PixelRange rows = PixelsIn(y - p.radius, y + p.radius, pixel, across);
    for (int j = rows.first; j <= rows.last; ++j) {
      for (int i = columns.first; i <= columns.last; ++i) {
        const double dx = (i + 0.5) * pixel - x;
        const double dy = (j + 0.5) * pixel - y;
        const double square = p.radius * p.radius - dx * dx - dy * dy;
        if (square < 0) continue;
        double& h = height[static_cast<std::size_t>(j) * static_cast<std::size_t>(along) +
                           static_cast<std::size_t>(i)];
        h = std::max(h, p.position.z + std::sqrt(square));
      }
    }
  }
  Layer layer;
  const auto count = static_cast<double>(height.size());
  for (const double h : height) {
    layer.coverage += h > 0 ? 1 / count : 0;
    layer.thickness += h / count;
  }
  for (const double h : height) {
    layer.roughness += (h - layer.thickness) * (h - layer.thickness) / count;
  }
  layer.roughness = std::sqrt(layer.roughness);
  return layer;
}

}  // namespace talus::rigs
