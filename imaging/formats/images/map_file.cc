#include "imaging/formats/images/map_file.h"

#include <algorithm>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"

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
  return {.width = image.width,
          .height = image.height,
          .pixel_size = plate_diameter / width,
          .center_x = (base.first + base.last + 1) / 2.0,
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
