#include "imaging/spheres/projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace talus::imaging {
namespace {

constexpr int kWordBits = 64;

// The silhouettes of all views, one bit a pixel: word (view, row, column / 64).
class Silhouettes {
 public:
  Silhouettes(const Frame& frame, int num_views)
      : frame_(frame),
        words_((frame.width + kWordBits - 1) / kWordBits),
        view_words_(static_cast<std::size_t>(words_) * static_cast<std::size_t>(frame.height)),
        bits_(view_words_ * static_cast<std::size_t>(num_views)) {}

  // Columns first … last of a row, within the image, first <= last.
  void Set(std::size_t view, int row, int first, int last) {
    std::uint64_t* const line = &bits_[view * view_words_ + static_cast<std::size_t>(row * words_)];
    const int low = first / kWordBits;
    const int high = last / kWordBits;
    const std::uint64_t from = ~std::uint64_t{0} << (first % kWordBits);
    const std::uint64_t to = ~std::uint64_t{0} >> (kWordBits - 1 - last % kWordBits);
    if (low == high) {
      line[low] |= from & to;
      return;
    }
    line[low] |= from;
    for (int word = low + 1; word < high; ++word) line[word] = ~std::uint64_t{0};
    line[high] |= to;
  }

  bool Get(std::size_t view, int row, int column) const {
    const std::uint64_t word =
        bits_[view * view_words_ + static_cast<std::size_t>(row * words_ + column / kWordBits)];
    return (word >> (column % kWordBits) & 1) != 0;
  }

  // Calls body(pixel index, whether it is powder) for every pixel of a view.
  template <class Body>
  void ForEachPixel(std::size_t view, Body&& body) const {
    std::size_t pixel = 0;
    for (int row = 0; row < frame_.height; ++row) {
      for (int column = 0; column < frame_.width; ++column) body(pixel++, Get(view, row, column));
    }
  }

 private:
  const Frame& frame_;
  int words_;  // a row
  std::size_t view_words_;
  std::vector<std::uint64_t> bits_;
};

struct Direction {
  double cosine = 1;
  double sine = 0;
};

std::vector<Direction> Directions(int num_views) {
  std::vector<Direction> directions;
  for (int view = 0; view < num_views; ++view) {
    const double angle = std::numbers::pi * view / num_views;
    directions.push_back({.cosine = std::cos(angle), .sine = std::sin(angle)});
  }
  return directions;
}

// A sphere's disc cut by one row of pixels.
struct RowSpan {
  int row = 0;
  double squared = 0;  // half-width² [px²]
  double half = 0;     // half-width [px]
};

// The last row whose pixel centres are above the baseline.
int LastRow(const Frame& frame) {
  return std::min(frame.height - 1, static_cast<int>(std::floor(frame.baseline - 0.5)));
}

// The rows do not depend on the view, so that one square root serves all of them.
void CutIntoRows(const base::Sphere& sphere, const Frame& frame, std::vector<RowSpan>& spans) {
  spans.clear();
  const double radius = sphere.radius / frame.pixel_size;
  const double center = frame.baseline - sphere.position.z / frame.pixel_size - 0.5;
  const double top = std::max(std::floor(center - radius), 0.0);
  const double bottom = std::min(std::ceil(center + radius), static_cast<double>(LastRow(frame)));
  for (int row = static_cast<int>(top); row <= bottom; ++row) {
    const double squared = radius * radius - (row - center) * (row - center);
    if (squared >= 0) {
      spans.push_back({.row = row, .squared = squared, .half = std::sqrt(squared)});
    }
  }
}

bool Inside(int column, double center, const RowSpan& span) {
  return (column - center) * (column - center) <= span.squared;
}

// The first column at or after `end`, which is off by a rounding at most: where a pixel's centre is
// so near that this could decide, the test itself does, so that the result equals that of testing
// every pixel. `step` +1 for the left end, -1 for the right one.
int EndColumn(double end, int step, double center, const RowSpan& span) {
  constexpr double kNear = 1e-6;  // [px]
  int column = static_cast<int>(step > 0 ? std::ceil(end) : std::floor(end));
  const double beyond = step * (column - end);  // in [0, 1)
  if (beyond < kNear && !Inside(column, center, span)) column += step;
  if (beyond > 1 - kNear && Inside(column - step, center, span)) column -= step;
  return column;
}

void Draw(std::size_t view, double center, const RowSpan& span, int width, Silhouettes& images) {
  const double left = std::max(center - span.half, -2.0);
  const double right = std::min(center + span.half, width + 1.0);
  if (!(left <= right)) return;
  const int first = std::max(EndColumn(left, +1, center, span), 0);
  const int last = std::min(EndColumn(right, -1, center, span), width - 1);
  if (first <= last) images.Set(view, span.row, first, last);
}

Silhouettes Render(std::span<const base::Sphere> spheres, const Frame& frame, int num_views) {
  base::Problems problems;
  frame.Validate(problems);
  problems.Require(num_views >= 1 && num_views <= 3600, "num_views", num_views,
                   "must be from 1 to 3600");
  problems.ThrowIfAny();
  const std::vector<Direction> directions = Directions(num_views);
  Silhouettes images(frame, num_views);
  std::vector<RowSpan> spans;
  for (const base::Sphere& sphere : spheres) {
    CutIntoRows(sphere, frame, spans);
    for (std::size_t view = 0; view < directions.size(); ++view) {
      const auto [cosine, sine] = directions[view];
      const double across = sphere.position.x * cosine + sphere.position.y * sine;
      const double center = frame.center_x + across / frame.pixel_size - 0.5;
      for (const RowSpan& span : spans) Draw(view, center, span, frame.width, images);
    }
  }
  return images;
}

GrayImage WhiteImage(int width, int height) {
  return {.width = width,
          .height = height,
          .pixels = std::vector<std::uint8_t>(
              static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255)};
}

// 255 (1 - n / N), rounded.
std::uint8_t Level(int num_powder, int num_views) {
  return static_cast<std::uint8_t>(255.0 * (num_views - num_powder) / num_views + 0.5);
}

}  // namespace

std::vector<GrayImage> ProjectViews(std::span<const base::Sphere> spheres, const Frame& frame,
                                    int num_views) {
  const Silhouettes silhouettes = Render(spheres, frame, num_views);
  std::vector<GrayImage> views(static_cast<std::size_t>(num_views),
                               WhiteImage(frame.width, frame.height));
  for (std::size_t view = 0; view < views.size(); ++view) {
    silhouettes.ForEachPixel(view, [&](std::size_t pixel, bool powder) {
      if (powder) views[view].pixels[pixel] = 0;
    });
  }
  return views;
}

Profile ProjectHeap(std::span<const base::Sphere> spheres, const Frame& frame, int num_views) {
  const Silhouettes silhouettes = Render(spheres, frame, num_views);
  Profile profile{.image = WhiteImage(frame.width, frame.height), .frame = frame};
  std::vector<int> count(profile.image.pixels.size());
  for (int view = 0; view < num_views; ++view) {
    silhouettes.ForEachPixel(static_cast<std::size_t>(view),
                             [&](std::size_t pixel, bool powder) { count[pixel] += powder; });
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    profile.image.pixels[i] = Level(count[i], num_views);
  }
  return profile;
}

GrayImage MeanImage(std::span<const GrayImage> images) {
  GrayImage mean = images.front();
  const auto count = static_cast<double>(images.size());
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    double sum = 0;
    for (const GrayImage& image : images) sum += image.pixels[i];
    mean.pixels[i] = static_cast<std::uint8_t>(sum / count + 0.5);
  }
  return mean;
}

}  // namespace talus::imaging
