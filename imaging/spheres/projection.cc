#include "imaging/spheres/projection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "base/error.h"
#include "base/parallel_for.h"

namespace talus::imaging {
namespace {

constexpr int kWordBits = 64;
constexpr std::size_t kViewsAtOnce = 4;  // by one thread, which cuts each sphere into rows once

// The silhouettes of all views, one bit a pixel: word (view, row, column / 64).
class Silhouettes {
 public:
  Silhouettes(const Frame& frame, int num_views)
      : words_((frame.width + kWordBits - 1) / kWordBits),
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

 private:
  int words_;  // a row
  std::size_t view_words_;
  std::vector<std::uint64_t> bits_;
};

constexpr double kSphereWork = 500;  // multiplications to draw one in a few views

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
  if (!(top <= bottom)) return;  // and so fits into an int
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

// Views `first` … `last` - 1.
void DrawViews(std::span<const base::Sphere> spheres, const Frame& frame,
               std::span<const Direction> directions, std::size_t first, Silhouettes& images) {
  const std::size_t last = std::min(first + kViewsAtOnce, directions.size());
  std::vector<RowSpan> spans;
  for (const base::Sphere& sphere : spheres) {
    CutIntoRows(sphere, frame, spans);
    for (std::size_t view = first; view < last; ++view) {
      const auto [cosine, sine] = directions[view];
      const double across = sphere.position.x * cosine + sphere.position.y * sine;
      const double center = frame.center_x + across / frame.pixel_size - 0.5;
      for (const RowSpan& span : spans) Draw(view, center, span, frame.width, images);
    }
  }
}

Silhouettes Render(std::span<const base::Sphere> spheres, const Frame& frame, int num_views) {
  base::Problems problems;
  frame.Validate(problems);
  problems.Require(num_views >= 1 && num_views <= 3600, "num_views", num_views,
                   "must be from 1 to 3600");
  constexpr double kMostPixels = 2e10;  // of all views together, a bit each
  problems.Require(static_cast<double>(frame.width) * frame.height * num_views <= kMostPixels,
                   "num_views", num_views, "times the frame's pixels must be at most 2e10");
  problems.ThrowIfAny();
  const std::vector<Direction> directions = Directions(num_views);
  Silhouettes images(frame, num_views);
  const std::size_t num_items = (directions.size() + kViewsAtOnce - 1) / kViewsAtOnce;
  base::ParallelFor({.num_items = static_cast<std::int64_t>(num_items),
                     .item_work = kSphereWork * static_cast<double>(spheres.size())},
                    [&](std::int64_t item) {
                      const std::size_t first = kViewsAtOnce * static_cast<std::size_t>(item);
                      DrawViews(spheres, frame, directions, first, images);
                    });
  return images;
}

GrayImage WhiteImage(int width, int height) {
  return {.width = width,
          .height = height,
          .pixels = std::vector<std::uint8_t>(
              static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255)};
}

std::size_t FirstPixel(const Frame& frame, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width);
}

void ForEachRow(const Frame& frame, int num_views, const std::function<void(int)>& body) {
  base::ParallelFor({.num_items = frame.height, .item_work = 2.0 * frame.width * num_views},
                    [&](std::int64_t row) { body(static_cast<int>(row)); });
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
  ForEachRow(frame, num_views, [&](int row) {
    std::size_t pixel = FirstPixel(frame, row);
    for (int column = 0; column < frame.width; ++column, ++pixel) {
      for (std::size_t view = 0; view < views.size(); ++view) {
        if (silhouettes.Get(view, row, column) && frame.Knows(column, row)) {
          views[view].pixels[pixel] = 0;
        }
      }
    }
  });
  return views;
}

Profile ProjectHeap(std::span<const base::Sphere> spheres, const Frame& frame, int num_views) {
  const Silhouettes silhouettes = Render(spheres, frame, num_views);
  Profile profile{.image = WhiteImage(frame.width, frame.height), .frame = frame};
  ForEachRow(frame, num_views, [&](int row) {
    std::size_t pixel = FirstPixel(frame, row);
    for (int column = 0; column < frame.width; ++column, ++pixel) {
      if (!frame.Knows(column, row)) continue;
      int num_powder = 0;
      for (std::size_t view = 0; view < static_cast<std::size_t>(num_views); ++view) {
        num_powder += silhouettes.Get(view, row, column) ? 1 : 0;
      }
      profile.image.pixels[pixel] = Level(num_powder, num_views);
    }
  });
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
