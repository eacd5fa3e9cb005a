#include "bench/optimizers/scale_factor_heaps.h"

#include <algorithm>

namespace talus::bench {
namespace {

constexpr double kBias = 0.08;  // displacement of each parameter per unit of f - 1, unit cube

}  // namespace

int NoiseLevel(double factor) { return factor < 1.2 ? 1 : factor < 1.8 ? 3 : 2; }

Image HeapAt(const Problem& problem, const Vec& x, double factor, std::uint64_t run) {
  const Vec direction{1, -1, 0.5};
  Vec displaced = x;
  for (std::size_t k = 0; k < displaced.size(); ++k) {
    displaced[k] = std::clamp(x[k] + kBias * (factor - 1) * direction[k], 0.0, 1.0);
  }
  return problem.MakeImage(displaced, run, NoiseLevel(factor));
}

Image Enlarged(const Image& image, int width, int height) {
  Image large{.w = width, .h = height, .px = {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int place = y * image.h / height * image.w + x * image.w / width;
      large.px.push_back(image.px[static_cast<std::size_t>(place)]);
    }
  }
  return large;
}

optimizer::ExperimentTarget TargetOf(const std::vector<Image>& heaps) {
  optimizer::ExperimentTarget target{.name = "heap"};
  const auto count = static_cast<float>(heaps.size());
  for (const Image& image : heaps) {
    target.image.width = image.w;
    target.image.height = image.h;
    target.image.target.resize(image.px.size());
    for (std::size_t i = 0; i < image.px.size(); ++i) {
      target.image.target[i] += image.px[i] / count;
    }
    target.runs.push_back(image.px);
  }
  target.image.sad_scale = 100.0 / (target.image.width * target.image.height);
  target.image.num_target_heaps = static_cast<int>(heaps.size());
  return target;
}

}  // namespace talus::bench
