#include "imaging/formats/images/map_file.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/heap_shape.h"
#include "imaging/heap/outline.h"

namespace talus::imaging {
namespace {

constexpr std::uint8_t kEveryView = 51;  // powder in at least 80 % of the views
constexpr std::uint8_t kSomeView = 250;  // lighter is the white of a noisy or compressed file
constexpr int kNarrowest = 8;            // base [px]

// Columns of the lowest row with powder in which nearly every view has it.
struct Base {
  int row = -1;
  int first = 0;
  int last = -1;
};

Base FindBase(const GrayImage& image) {
  Base base;
  for (int y = image.height - 1; y >= 0 && base.row < 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) < kSomeView) base.row = y;
    }
  }
  if (base.row < 0) return base;
  base.first = image.width;
  for (int x = 0; x < image.width; ++x) {
    if (image.at(x, base.row) > kEveryView) continue;
    base.first = std::min(base.first, x);
    base.last = x;
  }
  return base;
}

// Left and right end of the plate [px]. The centres of the lowest row lie half a row above it, by
// which slopes of 20 degrees have moved 1.4 px; they are drawn on by the two lowest rows. Of a heap
// that overhangs powder of some views hangs over the rim: there the columns of nearly every view
// count.
std::pair<double, double> Ends(const GrayImage& image, const Base& base) {
  constexpr double kOverhangs = 1;          // [px]
  constexpr double kSomeViews = 0.9 * 255;  // powder in a tenth of them
  const Frame frame{.width = image.width, .height = image.height, .baseline = base.row + 1.0};
  const Outline outline = FindOutline(image, frame);
  const Overhang overhang = WorstOverhang(outline, FindOutline(image, frame, kSomeViews));
  if (outline.rows.size() < 2 || std::max(overhang.left, overhang.right) > kOverhangs) {
    return {base.first, base.last + 1};
  }
  const RowExtent& lowest = outline.rows[0];
  const RowExtent& next = outline.rows[1];
  // A row far wider than the next is a plate's edge or a layer on it, and no part of a slope.
  constexpr double kFarthest = 4;  // [px], of a slope of 14 degrees
  if (std::max(next.left - lowest.left, lowest.right - next.right) > kFarthest) {
    return {base.first, base.last + 1};
  }
  return {1.5 * lowest.left - 0.5 * next.left, 1.5 * lowest.right - 0.5 * next.right};
}

Frame FindFrame(const GrayImage& image, double plate_diameter, const std::string& name) {
  const Base base = FindBase(image);
  if (base.row < 0) {
    throw base::ConfigError(name + ": is white everywhere; give a map with black for powder");
  }
  const int width = base.last - base.first + 1;
  if (width < kNarrowest) {
    throw base::ConfigError(name +
                            ": its lowest row with powder is not black along a base; give "
                            "the place of the plate with \"frame\"");
  }
  if (width >= image.width) {
    throw base::ConfigError(name +
                            ": its lowest row is black from border to border; black must "
                            "mean powder: invert the map, cut away what is below the base, "
                            "or give the place of the plate with \"frame\"");
  }
  const auto [left, right] = Ends(image, base);
  return {.width = image.width,
          .height = image.height,
          .pixel_size = plate_diameter / (right - left),
          .center_x = (left + right) / 2,
          .baseline = base.row + 1.0,
          .plate_diameter = plate_diameter};
}

// The plate and what is below it are not powder, and of a drum only its disc counts.
void BlankWhatDoesNotCount(Profile& profile) {
  for (int y = 0; y < profile.image.height; ++y) {
    const bool is_below = y + 0.5 >= profile.frame.baseline;
    for (int x = 0; x < profile.image.width; ++x) {
      if (is_below || !profile.frame.Knows(x, y)) profile.image.at(x, y) = 255;
    }
  }
}

void RequireFit(const Profile& profile, const std::string& name) {
  const auto& [image, frame] = profile;
  if (frame.width == image.width && frame.height == image.height) return;
  throw base::ConfigError(name + ": has " + std::to_string(image.width) + " x " +
                          std::to_string(image.height) +
                          " px; its frame must have the same width_px and height_px");
}

}  // namespace

Profile ReadMap(const std::filesystem::path& path, double plate_diameter,
                const std::optional<Frame>& frame) {
  Profile profile{.image = ReadGrayImage(path), .frame = {}};
  profile.frame = frame ? *frame : FindFrame(profile.image, plate_diameter, path.string());
  RequireFit(profile, path.string());
  BlankWhatDoesNotCount(profile);
  return profile;
}

}  // namespace talus::imaging
