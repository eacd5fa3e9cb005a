#include "imaging/photos/photo_reading.h"

#include <cstdint>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "base/parallel_for.h"
#include "imaging/formats/images/photograph_file.h"

namespace talus::imaging {
namespace {

constexpr std::size_t kMostKept = 256'000'000;  // of all photographs together [bytes]

std::vector<Photo> Unread(const PhotoSet& set) {
  std::vector<Photo> photos;
  for (std::size_t run = 0; run < set.runs.size(); ++run) {
    for (const PhotoFile& view : set.runs[run].views) {
      photos.emplace_back();
      photos.back().path = view.path;
      photos.back().run = run;
    }
  }
  return photos;
}

// One of `num_photos`, which are all of one size.
void Read(const ExperimentOptions& options, std::size_t num_photos, Photo& photo) {
  const std::string name = photo.path.string();
  try {
    const Photograph read = ReadPhotograph(photo.path);
    photo.width = read.width;
    photo.height = read.height;
    photo.block = read.block;
    photo.taken = read.taken;
    BacklitPhoto flat = FlattenPhoto(read.image, options.light(), name);
    photo.front_lit = flat.negative;
    photo.overexposed = flat.overexposed;
    photo.light = flat.light;
    photo.has_light = true;
    if (!options.scale.empty()) {
      photo.table = FindTable(flat, name);
    } else if (!options.frame) {
      photo.edges = FindPlateEdges(flat, name);
    }
    const std::size_t bytes = flat.image.pixels.size() * sizeof(float);
    if (bytes <= kMostKept / num_photos) photo.flat = std::move(flat);
  } catch (const base::ConfigError& error) {
    photo.fault = error.what();
    photo.lacks_plate = photo.has_light;
  }
}

}  // namespace

std::vector<Photo> ReadPhotos(const ExperimentOptions& options, const PhotoSet& set) {
  std::vector<Photo> photos = Unread(set);
  const auto read = [&](std::int64_t i) {
    Read(options, photos.size(), photos[static_cast<std::size_t>(i)]);
  };
  base::ParallelFor({.num_items = std::ssize(photos), .item_work = kPhotoWork}, read);
  return photos;
}

}  // namespace talus::imaging
