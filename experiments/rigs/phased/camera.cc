#include "experiments/rigs/phased/camera.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "experiments/rigs/phased/spheres.h"
#include "imaging/heap/closing.h"
#include "imaging/heap/film_strip.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {
namespace {

std::size_t NumPixels(const imaging::Frame& frame) {
  return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
}

// Frames with powder, pixel by pixel of the strip.
std::vector<int> CountsOf(const CameraMemory& memory, const imaging::Frame& frame) {
  std::vector<int> counts;
  counts.reserve(NumPixels(frame));
  for (std::size_t i = 0; i + 1 < memory.runs.size(); i += 2) {
    counts.insert(counts.end(), static_cast<std::size_t>(memory.runs[i + 1]), memory.runs[i]);
  }
  counts.resize(NumPixels(frame), 0);
  return counts;
}

std::vector<int> RunsOf(const std::vector<int>& counts) {
  std::vector<int> runs;
  for (const int count : counts) {
    if (runs.empty() || runs[runs.size() - 2] != count) {
      runs.push_back(count);
      runs.push_back(0);
    }
    ++runs.back();
  }
  return runs;
}

double StandardDeviation(int count, int num_frames) {
  const double p = static_cast<double>(count) / num_frames;
  return std::sqrt(p * (1 - p));
}

std::uint8_t Rounded(double level) { return static_cast<std::uint8_t>(level + 0.5); }

// Each picture by itself: what one shows does not touch the next.
imaging::GrayImage ClosedStrip(const imaging::Profile& strip, int reach) {
  std::vector<imaging::GrayImage> pictures;
  for (int i = 0; i < strip.frame.num_pictures(); ++i) {
    pictures.push_back(imaging::Closed(imaging::PictureOf(strip, i).image, reach));
  }
  return imaging::SideBySide(pictures);
}

// Squares of an odd number of pixels, as near to the width as can be.
int ReachOf(double width, double pixel_size) {
  return static_cast<int>(std::lround((width / pixel_size - 1) / 2));
}

}  // namespace

void TakePicture(std::span<const engine::Particle> grains, const imaging::Frame& frame,
                 const CameraOptions& camera, CameraMemory& memory) {
  const imaging::GrayImage view =
      std::move(imaging::ProjectViews(SpheresOf(grains), frame, 1).front());
  const imaging::Frame strip = imaging::StripOf(frame, camera.num_pictures());
  std::vector<int> counts = CountsOf(memory, strip);
  auto row = counts.begin() + memory.num_frames / camera.frames * frame.width;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) row[x] += view.at(x, y) == 0 ? 1 : 0;
    if (y + 1 < frame.height) row += strip.width;
  }
  memory.runs = RunsOf(counts);
  ++memory.num_frames;
}

Pictures PicturesOf(const CameraMemory& memory, const imaging::Frame& frame,
                    const CameraOptions& camera) {
  const bool any = camera.shows == Shown::kAny;
  const imaging::Frame strip = imaging::StripOf(frame, camera.num_pictures());
  const int num_frames = memory.num_frames / camera.num_pictures();
  Pictures pictures;
  pictures.profile = {.width = strip.width, .height = strip.height, .pixels = {}};
  pictures.standard_deviation = pictures.profile;
  for (const int count : CountsOf(memory, strip)) {
    const double unseen = num_frames - count;
    const double light = any ? (count == 0 ? 1 : 0) : unseen / num_frames;
    pictures.profile.pixels.push_back(Rounded(255 * light));
    pictures.standard_deviation.pixels.push_back(
        Rounded(255 * StandardDeviation(count, num_frames)));
  }
  if (camera.closing > 0) {
    pictures.profile = ClosedStrip({.image = pictures.profile, .frame = strip},
                                   ReachOf(camera.closing, frame.pixel_size));
  }
  return pictures;
}

std::string PictureFile(int picture) { return "profile_" + std::to_string(picture + 1) + ".png"; }

Reading CohesiveIndex(const CameraMemory& memory, const imaging::Frame& frame,
                      const CameraOptions& camera) {
  Reading index{Observable::kCohesiveIndex};
  const int num_frames = memory.num_frames / camera.num_pictures();
  if (num_frames < 2) {
    index.undefined = "one picture has no standard deviation";
    return index;
  }
  double sum = 0;
  for (const int count : CountsOf(memory, imaging::StripOf(frame, camera.num_pictures()))) {
    sum += StandardDeviation(count, num_frames);
  }
  index.value =
      sum / camera.num_pictures() * frame.pixel_size * frame.pixel_size / frame.plate_diameter;
  return index;
}

}  // namespace talus::rigs
