#include "experiments/analysis/batches/batch_pictures.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"

namespace talus::analysis {
namespace {

constexpr int kMostArrangements = 5000;

// The runs of an experiment, its plate's middle at the same pixel of equal canvases in both
// batches.
struct AlignedRuns {
  std::vector<imaging::GrayImage> first, second;
};

std::vector<imaging::GrayImage> OnCanvas(const journal::ExperimentRecord& e,
                                         const imaging::Frame& frame, int half_width, int height) {
  std::vector<imaging::GrayImage> images;
  const int left = half_width - static_cast<int>(std::lround(frame.center_x));
  const int top = height - static_cast<int>(std::lround(frame.baseline));
  for (const journal::RunRecord& run : e.runs) {
    const imaging::GrayImage image = imaging::DecodeGrayImage(run.png, e.name + ", " + run.name);
    imaging::GrayImage& canvas = images.emplace_back(
        imaging::GrayImage{.width = 2 * half_width, .height = height, .pixels = {}});
    canvas.pixels.assign(
        static_cast<std::size_t>(2 * half_width) * static_cast<std::size_t>(height), 255);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const int to_x = x + left;
        const int to_y = y + top;
        if (to_x < 0 || to_y < 0 || to_x >= canvas.width || to_y >= canvas.height) continue;
        canvas.at(to_x, to_y) = image.at(x, y);
      }
    }
  }
  return images;
}

AlignedRuns Align(const journal::ExperimentRecord& a, const imaging::Frame& frame_a,
                  const journal::ExperimentRecord& b, const imaging::Frame& frame_b) {
  const auto half = [](const imaging::Frame& f) {
    return static_cast<int>(std::ceil(std::max(f.center_x, f.width - f.center_x))) + 1;
  };
  const int half_width = std::max(half(frame_a), half(frame_b));
  const int height = static_cast<int>(std::lround(std::max(frame_a.baseline, frame_b.baseline)));
  return {OnCanvas(a, frame_a, half_width, height), OnCanvas(b, frame_b, half_width, height)};
}

double BinomialUpTo(std::size_t n, std::size_t k, double most) {
  double ways = 1;
  for (std::size_t i = 1; i <= k && ways <= most; ++i) {
    ways *= static_cast<double>(n - k + i) / static_cast<double>(i);
  }
  return ways;
}

}  // namespace

BatchPictures ComparePictures(const campaign::JointView& first, const campaign::JointView& batch,
                              std::size_t e) {
  const journal::ExperimentRecord& a = first.record.experiments[e];
  BatchPictures pictures{.batch = batch.folder.root.string(), .experiment = a.name};
  const auto& others = batch.record.experiments;
  const auto found = std::ranges::find(others, a.name, &journal::ExperimentRecord::name);
  if (found == others.end()) {
    pictures.absent = "the batch has no experiment of this name";
    return pictures;
  }
  if (a.runs.size() < 2 || found->runs.size() < 2) {
    pictures.absent = "fewer than two photographed runs show no scatter to compare with";
    return pictures;
  }
  const auto at = static_cast<std::size_t>(found - others.begin());
  const imaging::Frame frame_a = first.references[e].frame().value();
  const imaging::Frame frame_b = batch.references[at].frame().value();
  if (std::abs(frame_a.pixel_size / frame_b.pixel_size - 1) > 1e-3) {
    pictures.absent = "the pixels differ in size; give both specs the same pixel_size";
    return pictures;
  }
  const AlignedRuns runs = Align(a, frame_a, *found, frame_b);
  const PermutationTest test = Permute(runs.first, runs.second, first.spec.seed);
  const double pixel = 1e3 * frame_a.pixel_size;
  pictures.sad_mm2 = test.distance_px * pixel * pixel;
  pictures.probability = test.probability;
  pictures.num_arrangements = test.num_arrangements;
  return pictures;
}

PermutationTest Permute(const std::vector<imaging::GrayImage>& first,
                        const std::vector<imaging::GrayImage>& second, std::uint64_t seed) {
  std::vector<imaging::GrayImage> all = first;
  all.insert(all.end(), second.begin(), second.end());
  // Which of all are dealt to the first; sorted, so that every way comes once.
  std::vector<int> to_first(all.size(), 0);
  std::fill(to_first.begin(), to_first.begin() + static_cast<std::ptrdiff_t>(first.size()), 1);
  const auto distance = [&](const std::vector<int>& dealt) {
    std::vector<imaging::GrayImage> a, b;
    for (std::size_t i = 0; i < all.size(); ++i) (dealt[i] == 1 ? a : b).push_back(all[i]);
    return imaging::Sad(imaging::MeanImage(a), imaging::MeanImage(b));
  };
  PermutationTest test{.distance_px = distance(to_first)};
  int as_large = 0;
  const auto count = [&](const std::vector<int>& dealt) {
    as_large += distance(dealt) >= test.distance_px * (1 - 1e-12);
    ++test.num_arrangements;
  };
  if (BinomialUpTo(all.size(), first.size(), kMostArrangements) <= kMostArrangements) {
    std::vector<int> dealt = to_first;
    std::sort(dealt.begin(), dealt.end());
    do {
      count(dealt);
    } while (std::next_permutation(dealt.begin(), dealt.end()));
  } else {
    count(to_first);
    base::Random random(seed, base::Stream("batches"));
    while (test.num_arrangements < kMostArrangements) {
      std::vector<int> dealt = to_first;
      for (std::size_t i = dealt.size() - 1; i > 0; --i) {
        std::swap(dealt[i], dealt[random.Below(i + 1)]);
      }
      count(dealt);
    }
  }
  test.probability = static_cast<double>(as_large) / test.num_arrangements;
  return test;
}

}  // namespace talus::analysis
