// A photograph seen in the directions of the plate, between its pixels.
#pragma once

#include <cmath>
#include <optional>

#include "imaging/light/backlight.h"
#include "imaging/photos/plate/plate_edges.h"

namespace talus::imaging {

class TiltedView {
 public:
  TiltedView(const BacklitPhoto& photo, double tilt)
      : photo_(photo), cosine_(std::cos(tilt)), sine_(std::sin(tilt)) {}

  const RelativeImage& image() const { return photo_.image; }
  double threshold() const { return photo_.threshold; }

  // From `origin`, `along` to the right and `up`, both as the plate lies.
  EdgePoint Point(const EdgePoint& origin, double along, double up) const {
    return {.x = origin.x + along * cosine_ + up * sine_,
            .y = origin.y + along * sine_ - up * cosine_};
  }
  // The way from `origin` to `point`: x along the plate to the right, y up from it.
  EdgePoint AsPlateLies(const EdgePoint& origin, const EdgePoint& point) const {
    const double x = point.x - origin.x;
    const double y = point.y - origin.y;
    return {.x = x * cosine_ + y * sine_, .y = x * sine_ - y * cosine_};
  }
  // Linear between pixel centres; light outside the image.
  double At(const EdgePoint& point) const {
    const double x = point.x - 0.5;
    const double y = point.y - 0.5;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const RelativeImage& image = photo_.image;
    if (column < 0 || row < 0 || column + 1 >= image.width || row + 1 >= image.height) return 1;
    const double right = x - column;
    const double below = y - row;
    return (1 - below) * ((1 - right) * image.at(column, row) + right * image.at(column + 1, row)) +
           below *
               ((1 - right) * image.at(column, row + 1) + right * image.at(column + 1, row + 1));
  }
  // How far one can go from a dark point in steps of `step` (up > 0, down < 0) until it gets light,
  // within `reach`; nothing when it does not, or when it is light to begin with.
  std::optional<double> DarkUntil(const EdgePoint& from, double step, double reach) const {
    double before = At(from);
    if (before >= photo_.threshold) return std::nullopt;
    for (double way = step; std::abs(way) <= reach; way += step) {
      const double here = At(Point(from, 0, way));
      if (here >= photo_.threshold) {
        return way - step * (here - photo_.threshold) / (here - before);
      }
      before = here;
    }
    return std::nullopt;
  }

 private:
  const BacklitPhoto& photo_;
  double cosine_;
  double sine_;
};

}  // namespace talus::imaging
