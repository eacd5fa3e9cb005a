#include "imaging/photos/placement.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "imaging/photos/scale_mark.h"

namespace talus::imaging {
namespace {

double MeanOver(const std::vector<PlatePose>& poses, double PlatePose::*part) {
  double sum = 0;
  for (const PlatePose& pose : poses) sum += pose.*part;
  return sum / static_cast<double>(poses.size());
}

// Centre and baseline on pixel borders, near where the photographs have them.
Frame FrameFor(const ExperimentOptions& options, const PhotoCollection& collection,
               const Placement& placement) {
  const double pixel = options.pixel_size.value_or(placement.photo_pixel);
  const double scale = pixel / placement.photo_pixel;
  const int width = collection.width / collection.block;
  const int height = collection.height / collection.block;
  return {.width = std::max(1, static_cast<int>(std::lround(width / scale))),
          .height = std::max(1, static_cast<int>(std::lround(height / scale))),
          .pixel_size = pixel,
          .center_x = std::round(MeanOver(placement.poses, &PlatePose::center_x) / scale),
          .baseline = std::round(MeanOver(placement.poses, &PlatePose::baseline) / scale),
          .plate_diameter = options.plate_diameter};
}

Placement PlaceByFrame(const ExperimentOptions& options, const PhotoCollection& collection) {
  const Frame& given = *options.frame;
  if (given.width != collection.width || given.height != collection.height) {
    throw base::ConfigError("frame: is " + PixelSizeText(given.width, given.height) +
                            ", the photographs are " +
                            PixelSizeText(collection.width, collection.height) +
                            "; give width_px and height_px of the photographs");
  }
  const int block = collection.block;
  Placement placement{.frame = given, .photo_pixel = given.pixel_size * block, .poses = {}};
  placement.poses.assign(collection.photos.size(),
                         {.width = given.plate_diameter / placement.photo_pixel,
                          .center_x = given.center_x / block,
                          .baseline = given.baseline / block,
                          .tilt = options.tilt});
  placement.frame = FrameFor(options, collection, placement);
  placement.frame.table = given.table;
  return placement;
}

// A length that no such picture holds was read off another one, of another scale. Its points may
// lie beyond one that was cropped.
void RequireInPicture(const ScaleMark& mark, const PhotoCollection& collection) {
  const double length = std::hypot(mark.x2 - mark.x1, mark.y2 - mark.y1);
  if (length <= std::hypot(collection.width, collection.height)) return;
  throw base::ConfigError("scale: is longer than the photographs, which are " +
                          PixelSizeText(collection.width, collection.height) +
                          "; give two points of one of them, or of a photograph that the same "
                          "camera took of a ruler, in pixels from its upper left corner");
}

// Share of the table's part that counts beyond the picture's left and right border.
double ShareUnseen(const PlatePose& part, int picture_width) {
  const double left = std::max(0.0, part.width / 2 - part.center_x);
  const double right = std::max(0.0, part.center_x + part.width / 2 - picture_width);
  return (left + right) / part.width;
}

// A heap on a table: its middle is where a plate's would be, and the table counts as far as
// `plate_diameter` says, or a little farther than the heap reaches.
Placement PlaceByScale(ExperimentOptions options, const PhotoCollection& collection) {
  constexpr double kBeyondHeap = 1.1;
  const ScaleMark mark = ParseScale(options.scale);
  RequireInPicture(mark, collection);
  const double photo_pixel = mark.pixel_size() * collection.block;
  Placement placement{.frame = {}, .photo_pixel = photo_pixel, .poses = {}};
  double reach = 0;  // [px]
  for (const Photo& photo : collection.photos) reach = std::max(reach, photo.table.reach);
  const bool is_given = options.plate_diameter > 0;
  if (!is_given) {
    options.plate_diameter = 1e-3 * std::ceil(1e3 * 2 * kBeyondHeap * reach * photo_pixel);
  }
  for (const Photo& photo : collection.photos) {
    placement.poses.push_back({.width = options.plate_diameter / photo_pixel,
                               .center_x = photo.table.center_x,
                               .baseline = photo.table.baseline,
                               .tilt = photo.table.tilt});
    if (!is_given) continue;
    placement.unseen = std::max(
        placement.unseen, ShareUnseen(placement.poses.back(), collection.width / collection.block));
  }
  placement.frame = FrameFor(options, collection, placement);
  placement.frame.table = true;
  return placement;
}

Placement PlaceByPlate(const ExperimentOptions& options, const PhotoCollection& collection) {
  std::vector<PhotographedPlate> plates;
  for (const Photo& photo : collection.photos) {
    plates.push_back({.edges = photo.edges, .run = photo.run});
  }
  PlateFit fit = FitPlates(plates);
  Placement placement{.frame = {},
                      .photo_pixel = options.plate_diameter / fit.width,
                      .poses = std::move(fit.poses),
                      .hidden_top = !fit.sharp_corners};
  placement.frame = FrameFor(options, collection, placement);
  return placement;
}

}  // namespace

Placement Place(const ExperimentOptions& options, const PhotoCollection& collection) {
  if (options.frame) return PlaceByFrame(options, collection);
  Placement placement =
      options.scale.empty() ? PlaceByPlate(options, collection) : PlaceByScale(options, collection);
  if (placement.frame.baseline < 1) {
    throw base::ConfigError(collection.photos.front().path.string() +
                            ": what was taken for the plate lies at the upper border; give the "
                            "plate's place with \"frame\", or crop what hangs above the heap");
  }
  return placement;
}

}  // namespace talus::imaging
