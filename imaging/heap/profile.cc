#include "imaging/heap/profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace talus::imaging {
namespace {

constexpr double kMostBeyondImage = 0.01;  // of a drum's baseline / diameter

}  // namespace

void Frame::Validate(base::Problems& problems) const {
  problems.Require(width > 0 && width <= 65500, "width_px", width, "must be from 1 to 65500");
  problems.Require(height > 0 && height <= 65500, "height_px", height, "must be from 1 to 65500");
  problems.Require(std::int64_t{width} * height <= 200'000'000, "width_px", width,
                   "px times the height must be at most 200 million");
  problems.Require(pixel_size > 0 && pixel_size < 1, "pixel_size", pixel_size,
                   "must be positive and below 1 m");
  problems.Require(plate_diameter > 0 && plate_diameter <= 2, "plate_diameter", plate_diameter,
                   "must be positive and at most 2 m");
  problems.Require(!disc_diameter || (*disc_diameter > 0 && *disc_diameter <= plate_diameter),
                   "disc_diameter", disc_diameter.value_or(0),
                   "must be positive and at most plate_diameter");
  problems.Require(!pictures || (*pictures >= 1 && width % *pictures == 0), "pictures",
                   pictures.value_or(0), "must be 1 or more, and divide width_px");
  problems.Require(center_x >= 0 && center_x <= width / std::max(1, num_pictures()), "center_x_px",
                   center_x, "must be within the image, of a film within its first picture");
  // A drum's lowest point may lie a little below its picture (RequireWhole in drum_circle.cc).
  const double beyond = disc_diameter ? kMostBeyondImage * plate_diameter / pixel_size : 0;  // [px]
  problems.Require(baseline >= 1 && baseline <= height + beyond, "baseline_px", baseline,
                   "must be within the image, below its first row");
}

bool Frame::Knows(int column, int row) const {
  if (!disc_diameter) return true;
  const double axis = baseline - plate_diameter / (2 * pixel_size);  // its row [px]
  return std::hypot(column % picture_width() + 0.5 - center_x, row + 0.5 - axis) <=
         *disc_diameter / (2 * pixel_size);
}

}  // namespace talus::imaging
