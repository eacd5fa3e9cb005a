#include "experiments/rigs/phased/camera.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "experiments/rigs/phased/spheres.h"
#include "imaging/heap/closing.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {
namespace {

std::size_t NumPixels(const imaging::Frame& frame) {
  return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
}

// Frames with powder, pixel by pixel.
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

// Squares of an odd number of pixels, as near to the width as can be.
int ReachOf(double width, double pixel_size) {
  return static_cast<int>(std::lround((width / pixel_size - 1) / 2));
}

}  // namespace

void TakePicture(std::span<const engine::Particle> grains, const imaging::Frame& frame,
                 CameraMemory& memory) {
  const imaging::GrayImage view =
      std::move(imaging::ProjectViews(SpheresOf(grains), frame, 1).front());
  std::vector<int> counts = CountsOf(memory, frame);
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += view.pixels[i] == 0 ? 1 : 0;
  memory.runs = RunsOf(counts);
  ++memory.num_frames;
}

Pictures PicturesOf(const CameraMemory& memory, const imaging::Frame& frame,
                    const CameraOptions& camera) {
  const bool any = camera.shows == Shown::kAny;
  Pictures pictures;
  pictures.profile = {.width = frame.width, .height = frame.height, .pixels = {}};
  pictures.standard_deviation = pictures.profile;
  for (const int count : CountsOf(memory, frame)) {
    const double unseen = memory.num_frames - count;
    const double light = any ? (count == 0 ? 1 : 0) : unseen / memory.num_frames;
    pictures.profile.pixels.push_back(Rounded(255 * light));
    pictures.standard_deviation.pixels.push_back(
        Rounded(255 * StandardDeviation(count, memory.num_frames)));
  }
  if (camera.closing > 0) {
    pictures.profile = imaging::Closed(pictures.profile, ReachOf(camera.closing, frame.pixel_size));
  }
  return pictures;
}

Reading CohesiveIndex(const CameraMemory& memory, const imaging::Frame& frame) {
  Reading index{Observable::kCohesiveIndex};
  if (memory.num_frames < 2) {
    index.undefined = "one picture has no standard deviation";
    return index;
  }
  double sum = 0;
  for (const int count : CountsOf(memory, frame))
    sum += StandardDeviation(count, memory.num_frames);
  index.value = sum * frame.pixel_size * frame.pixel_size / frame.plate_diameter;
  return index;
}

}  // namespace talus::rigs
