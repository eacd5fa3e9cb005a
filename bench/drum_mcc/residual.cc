// drum_residual PHOTO TRIAL [OVERLAY.png]: how far a simulated drum is from its photographs: the
// area in which the two differ, both made binary (powder where any picture of the series has it),
// closed over 7 px, inside 0.775 of the drum's radius (README.md). The photograph's drum fills the
// picture. The overlay shows powder of both grey, of the photograph alone blue, of the simulation
// alone red.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include "base/json/json_reader.h"
#include "imaging/color_image.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/closing.h"
#include "imaging/heap/profile.h"

namespace {

using namespace talus;

constexpr int kLight = 225;          // a pixel of the average that is darker was powder once
constexpr int kReach = 3;            // of the closing: 7 px wide
constexpr double kCounts = 0.77460;  // √0.6 of the radius

imaging::Frame FrameOf(const std::filesystem::path& trial) {
  const base::JsonFile file = base::ReadJsonFile(trial / "case.json");
  imaging::Frame frame;
  base::Problems problems(file.path.string(), file.places);
  base::ReadOptions(file.root.at("frame"), frame, {problems, {}});
  problems.ThrowIfAny();
  return frame;
}

// The trial's picture on the photograph's pixels, 0 where any of its frames shows powder.
imaging::GrayImage OnPhoto(const std::filesystem::path& trial, const imaging::GrayImage& photo) {
  const imaging::GrayImage profile = imaging::ReadGrayImage(trial / "profile.png");
  const imaging::Frame frame = FrameOf(trial);
  const double pixel = frame.plate_diameter / photo.width;  // [m]
  imaging::GrayImage image = photo;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double right = (x + 0.5 - photo.width / 2.0) * pixel;
      const double up = (photo.height / 2.0 - y - 0.5) * pixel + frame.plate_diameter / 2;
      const int u = static_cast<int>(std::floor(frame.center_x + right / frame.pixel_size));
      const int v = static_cast<int>(std::floor(frame.baseline - up / frame.pixel_size));
      const bool inside = u >= 0 && v >= 0 && u < profile.width && v < profile.height;
      image.at(x, y) = inside && profile.at(u, v) < 255 ? 0 : 255;
    }
  }
  return image;
}

int Run(int count, char** arguments) {
  if (count < 3 || count > 4) {
    std::fprintf(stderr, "usage: drum_residual PHOTO TRIAL [OVERLAY.png]\n");
    return 2;
  }
  const imaging::GrayImage photo = imaging::ReadGrayImage(arguments[1]);
  const imaging::GrayImage seen = imaging::Closed(photo, kReach);
  const imaging::GrayImage simulated = imaging::Closed(OnPhoto(arguments[2], photo), kReach);
  imaging::ColorImage overlay{.width = photo.width, .height = photo.height, .pixels = {}};
  int missing = 0, beyond = 0;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double r = std::hypot(x + 0.5 - photo.width / 2.0, y + 0.5 - photo.height / 2.0);
      const bool counts = r <= kCounts * photo.width / 2;
      const bool powder = seen.at(x, y) < kLight, drawn = simulated.at(x, y) < 128;
      missing += counts && powder && !drawn;
      beyond += counts && !powder && drawn;
      const std::uint8_t light = counts ? 255 : 225;
      if (powder && drawn) {
        overlay.pixels.push_back({110, 110, 110});
      } else if (powder) {
        overlay.pixels.push_back({30, 80, 220});
      } else if (drawn) {
        overlay.pixels.push_back({220, 40, 30});
      } else {
        overlay.pixels.push_back({light, light, light});
      }
    }
  }
  const double pixel = 1e3 * FrameOf(arguments[2]).plate_diameter / photo.width;  // [mm]
  std::printf("%.1f mm2: powder of the photograph alone %.1f, of the simulation alone %.1f\n",
              (missing + beyond) * pixel * pixel, missing * pixel * pixel, beyond * pixel * pixel);
  if (count == 4) imaging::WritePng(arguments[3], overlay);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return Run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "drum_residual: %s\n", error.what());
    return 1;
  }
}
