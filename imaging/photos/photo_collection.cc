#include "imaging/photos/photo_collection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/parallel_for.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/photos/backlight.h"
#include "imaging/photos/overlay.h"
#include "imaging/photos/photo_set.h"

namespace talus::imaging {
namespace {

constexpr double kSameScale = 0.01;  // how far a photograph's plate width may be off the median [-]

using DroppedPhotos = std::vector<bool>;

PhotoCollection NameFiles(const ExperimentOptions& options) {
  PhotoCollection collection;
  const auto add = [&](const std::filesystem::path& path) {
    collection.photos.push_back({.path = path,
                                 .run = collection.runs.size(),
                                 .edges = {},
                                 .table = {},
                                 .front_lit = false,
                                 .image = {}});
  };
  if (!options.runs.empty()) {
    std::size_t most = 0;
    for (const PhotoRun& run : options.runs) most = std::max(most, run.photos.size());
    for (const PhotoRun& run : options.runs) {
      for (const auto& path : run.photos) add(path);
      collection.runs.push_back(run.name);
      if (run.photos.size() == most) continue;
      collection.faults.push_back({.photo = {},
                                   .reason = "run " + run.name + " has " +
                                             std::to_string(run.photos.size()) +
                                             " views, others have " + std::to_string(most)});
    }
    return collection;
  }
  PhotoSet set = FindPhotos(options.photos, options.pattern);
  for (const PhotoFiles& run : set.runs) {
    for (const PhotoFile& view : run.views) add(view.path);
    collection.runs.push_back(run.run);
  }
  for (std::string& missing : set.missing) {
    collection.faults.push_back({.photo = {}, .reason = std::move(missing)});
  }
  return collection;
}

void Drop(const DroppedPhotos& bad, PhotoCollection& collection) {
  std::vector<Photo> kept;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    if (!bad[i]) kept.push_back(std::move(collection.photos[i]));
  }
  collection.photos = std::move(kept);
}

std::string Size(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

// What one photograph shows by itself.
struct Reading {
  int width = 0;   // [px]; 0: unreadable
  int height = 0;  // [px]
  PlateEdges edges;
  TableLine table;
  bool front_lit = false;
  std::string fault;  // "": none
  GrayImage image;    // kept where there is room for all
};

constexpr std::size_t kMostKept = 256'000'000;  // [bytes]

// One of `num_photos`, which are all of one size.
Reading Read(const ExperimentOptions& options, const Photo& photo, std::size_t num_photos) {
  Reading reading;
  try {
    GrayImage image = ReadGrayImage(photo.path);
    reading.width = image.width;
    reading.height = image.height;
    const BacklitPhoto flat = Flatten(options, image, photo.path);
    reading.front_lit = flat.negative;
    if (!options.scale.empty()) {
      reading.table = FindTable(flat, photo.path.string());
    } else if (!options.frame) {
      reading.edges = FindPlateEdges(flat, photo.path.string());
    }
    if (image.pixels.size() <= kMostKept / num_photos) reading.image = std::move(image);
  } catch (const base::ConfigError& error) {
    reading.fault = error.what();
  }
  return reading;
}

// The size that most photographs have is not known before all are read; the first readable one
// stands for it.
void CheckSize(const Reading& image, const Photo& photo, PhotoCollection& collection) {
  if (collection.width == 0) {
    collection.width = image.width;
    collection.height = image.height;
  }
  if (image.width == collection.width && image.height == collection.height) return;
  throw base::ConfigError(photo.path.string() + ": has " + Size(image.width, image.height) +
                          ", the photographs before it " +
                          Size(collection.width, collection.height) +
                          "; all photographs must be of one size and scale");
}

// The photograph with what was found in it, and where that picture is; nothing for one that cannot
// be drawn or when nobody keeps it.
std::string KeepPicture(const ExperimentOptions& options, const Photo& photo,
                        const std::optional<PlateEdges>& edges, const PictureSink& keep) {
  if (!keep) return {};
  try {
    const GrayImage image = ReadGrayImage(photo.path);
    const BacklitPhoto flat = Flatten(options, image, photo.path);
    return " (see " + keep(photo.path, DrawFault(image, flat, edges)).string() + ")";
  } catch (const base::ConfigError&) {
    return {};  // unreadable, black or blank: the fault says so
  }
}

// Reads every photograph; one that cannot be used becomes a fault.
void FindPlates(const ExperimentOptions& options, const PictureSink& keep,
                PhotoCollection& collection) {
  std::vector<Reading> readings(collection.photos.size());
  ForEachPhoto(readings.size(), [&](std::size_t i) {
    readings[i] = Read(options, collection.photos[i], readings.size());
  });
  DroppedPhotos bad(collection.photos.size(), false);
  for (std::size_t i = 0; i < collection.photos.size(); ++i) {
    Photo& photo = collection.photos[i];
    Reading& reading = readings[i];
    try {
      if (reading.width > 0) CheckSize(reading, photo, collection);
      if (!reading.fault.empty()) throw base::ConfigError(reading.fault);
      photo.front_lit = reading.front_lit;
      photo.edges = std::move(reading.edges);
      photo.image = std::move(reading.image);
      photo.table = reading.table;
    } catch (const base::ConfigError& error) {
      collection.faults.push_back(
          {.photo = photo.path,
           .reason = error.what() + KeepPicture(options, photo, std::nullopt, keep)});
      bad[i] = true;
    }
  }
  Drop(bad, collection);
}

void CheckScale(const ExperimentOptions& options, const PictureSink& keep,
                PhotoCollection& collection) {
  std::vector<double> widths;
  for (const Photo& photo : collection.photos) widths.push_back(photo.edges.width);
  if (widths.empty()) return;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  const double median = *middle;
  DroppedPhotos bad(collection.photos.size(), false);
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const Photo& photo = collection.photos[i];
    if (std::abs(photo.edges.width - median) <= kSameScale * median) continue;
    std::ostringstream text;
    text.precision(4);
    text << photo.path.string() << ": its plate is " << photo.edges.width
         << " px wide, that of the other photographs " << median
         << " px; all must be taken at one scale: take it again, give the plate's place with "
            "\"frame\", or leave it out"
         << KeepPicture(options, photo, photo.edges, keep);
    collection.faults.push_back({.photo = photo.path, .reason = text.str()});
    bad[i] = true;
  }
  Drop(bad, collection);
}

// Faults end the work, or become warnings. Going on without most of the photographs is no remedy:
// then it is the scene or the options that do not fit.
void SettleFaults(const ExperimentOptions& options, const PictureSink& keep,
                  PhotoCollection& collection, std::vector<PhotoWarning>& warnings) {
  std::string all;
  for (const PhotoFault& fault : collection.faults) all += (all.empty() ? "" : "\n") + fault.reason;
  const bool few = collection.faults.size() <= collection.photos.size();
  std::string remedy =
      few ? "\nput them right, or go on without them: --allow-missing-views"
          : "\nmost photographs have a fault: give the plate's place with \"frame\", or say with "
            "\"powder\" how they are lit";
  if (!keep) remedy += "\n`talus measure PHOTOS … --out DIR` draws what was found in each";
  if (!all.empty() && !options.allow_missing_views) throw base::ConfigError(all + remedy);
  if (collection.photos.empty()) throw base::ConfigError(all + "\nno photograph is left");
  for (PhotoFault& fault : collection.faults) {
    warnings.push_back({.doubt = PhotoDoubt::kLeftOut, .reason = std::move(fault.reason)});
  }
}

}  // namespace

BacklitPhoto Flatten(const ExperimentOptions& options, const GrayImage& image,
                     const std::filesystem::path& photo) {
  return options.scale.empty() ? FlattenPhoto(image, options.light(), photo.string())
                               : FlattenAboveTable(image, options.light(), photo.string());
}

void ForEachPhoto(std::size_t num_photos, const std::function<void(std::size_t)>& body) {
  constexpr double kPhotoWork = 1e9;
  base::ParallelFor({.num_items = static_cast<std::int64_t>(num_photos), .item_work = kPhotoWork},
                    [&](std::int64_t i) { body(static_cast<std::size_t>(i)); });
}

PhotoCollection CollectPhotos(const ExperimentOptions& options, const PictureSink& keep,
                              std::vector<PhotoWarning>& warnings) {
  PhotoCollection collection = NameFiles(options);
  FindPlates(options, keep, collection);
  if (!options.frame && options.scale.empty()) CheckScale(options, keep, collection);
  SettleFaults(options, keep, collection, warnings);
  return collection;
}

}  // namespace talus::imaging
