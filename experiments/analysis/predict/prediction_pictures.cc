#include "experiments/analysis/predict/prediction_pictures.h"

#include <cmath>
#include <numeric>

#include "experiments/analysis/compare/heap_pair.h"
#include "imaging/drawing/canvas.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"

namespace talus::analysis {
namespace {

constexpr std::uint8_t kHalf = 128;  // powder is what is darker

// Share of the runs in which a pixel is powder, by pixel.
std::vector<double> PowderShare(const PredictionRuns& runs) {
  std::vector<double> share;
  double total = 0;
  for (std::size_t d = 0; d < runs.weights().size(); ++d) {
    const std::vector<imaging::GrayImage> images = runs.ImagesOf(d);
    for (const imaging::GrayImage& image : images) {
      const double weight = runs.weights()[d] / static_cast<double>(images.size());
      share.resize(image.pixels.size());
      total += weight;
      for (std::size_t i = 0; i < share.size(); ++i) {
        if (image.pixels[i] < kHalf) share[i] += weight;
      }
    }
  }
  for (double& s : share) s /= total;
  return share;
}

// The pixels at the edge of where the share reaches a level.
void DrawEdge(const std::vector<double>& share, double level, int zoom, const imaging::Color& color,
              const imaging::GrayImage& size, imaging::ColorImage& canvas) {
  const auto reaches = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < size.width && y < size.height &&
           share[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                 static_cast<std::size_t>(x)] >= level;
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool inner =
          reaches(x - 1, y) && reaches(x + 1, y) && reaches(x, y - 1) && reaches(x, y + 1);
      if (!reaches(x, y) || inner) continue;
      imaging::FillBox(canvas, {double(zoom * x), double(zoom * y)},
                       {double(zoom * (x + 1) - 1), double(zoom * (y + 1) - 1)}, color);
    }
  }
}

struct Pair {
  std::size_t first = 0;
  std::size_t second = 0;
};

Pair MostDifferent(const std::vector<imaging::GrayImage>& means) {
  Pair pair;
  double largest = -1;
  for (std::size_t a = 0; a < means.size(); ++a) {
    for (std::size_t b = a + 1; b < means.size(); ++b) {
      const double sad = imaging::Sad(means[a], means[b]);
      if (sad <= largest) continue;
      largest = sad;
      pair = {a, b};
    }
  }
  return pair;
}

}  // namespace

imaging::GrayImage WeightedMean(std::span<const imaging::GrayImage> images,
                                const std::vector<double>& weights) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> sum(images.front().pixels.size());
  for (std::size_t k = 0; k < images.size(); ++k) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[k] * images[k].pixels[i];
  }
  imaging::GrayImage mean = images.front();
  for (std::size_t i = 0; i < sum.size(); ++i) {
    mean.pixels[i] = static_cast<std::uint8_t>(std::lround(sum[i] / total));
  }
  return mean;
}

void WritePictures(const PredictionRuns& runs, const std::filesystem::path& folder,
                   Prediction& prediction) {
  std::vector<imaging::GrayImage> means;
  std::vector<double> weights;
  std::vector<int> draws;
  for (std::size_t d = 0; d < runs.weights().size(); ++d) {
    const std::vector<imaging::GrayImage> images = runs.ImagesOf(d);
    if (images.empty()) continue;
    means.push_back(imaging::MeanImage(images));
    weights.push_back(runs.weights()[d]);
    draws.push_back(static_cast<int>(d));
  }
  if (means.empty()) return;
  const imaging::GrayImage mean = WeightedMean(means, weights);
  const int zoom = imaging::OverlayZoom(mean);
  imaging::ColorImage canvas = imaging::Enlarged(mean, zoom);
  const std::vector<double> share = PowderShare(runs);
  DrawEdge(share, 0.05, zoom, imaging::kBlue, mean, canvas);
  DrawEdge(share, 0.95, zoom, imaging::kRed, mean, canvas);
  prediction.mean_profile = "mean_profile.png";
  imaging::WritePng(folder / prediction.mean_profile, canvas);
  if (means.size() < 2) return;
  const Pair pair = MostDifferent(means);
  prediction.different = {draws[pair.first], draws[pair.second]};
  prediction.most_different = "most_different.png";
  WriteHeapPair(folder / prediction.most_different, means[pair.first], means[pair.second]);
}

}  // namespace talus::analysis
