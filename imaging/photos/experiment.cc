#include "imaging/photos/experiment.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "base/error.h"
#include "imaging/formats/image_file.h"
#include "imaging/formats/map_file.h"
#include "imaging/photos/backlight.h"
#include "imaging/photos/photo_set.h"
#include "imaging/photos/plate_edges.h"
#include "imaging/photos/silhouette.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace {

constexpr double kSameScale = 0.01;  // how far a photograph's plate width may be off the median [-]

struct Photo {
  std::filesystem::path path;
  std::size_t run = 0;
  PlateEdges edges;  // unless the frame is given
};

// Runs and photographs as they are to be used, and everything that is wrong with them.
struct Collection {
  std::vector<std::string> runs;  // names
  std::vector<Photo> photos;      // run by run
  int width = 0;                  // of every photograph [px]
  int height = 0;                 // [px]
  std::vector<std::string> faults;

  void Drop(const std::vector<bool>& bad) {
    std::vector<Photo> kept;
    for (std::size_t i = 0; i < photos.size(); ++i) {
      if (!bad[i]) kept.push_back(std::move(photos[i]));
    }
    photos = std::move(kept);
  }
};

Collection Collect(const ExperimentOptions& options) {
  Collection collection;
  const auto add = [&](const std::filesystem::path& path) {
    collection.photos.push_back({.path = path, .run = collection.runs.size(), .edges = {}});
  };
  if (!options.runs.empty()) {
    std::size_t most = 0;
    for (const PhotoRun& run : options.runs) most = std::max(most, run.photos.size());
    for (const PhotoRun& run : options.runs) {
      for (const auto& path : run.photos) add(path);
      collection.runs.push_back(run.name);
      if (run.photos.size() == most) continue;
      collection.faults.push_back("run " + run.name + " has " + std::to_string(run.photos.size()) +
                                  " views, others have " + std::to_string(most));
    }
    return collection;
  }
  PhotoSet set = FindPhotos(options.photos, options.pattern);
  for (const PhotoFiles& run : set.runs) {
    for (const PhotoFile& view : run.views) add(view.path);
    collection.runs.push_back(run.run);
  }
  collection.faults = std::move(set.missing);
  return collection;
}

std::string Size(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

// The size that most photographs have is not known before all are read; the first readable one
// stands for it.
void CheckSize(const GrayImage& image, const Photo& photo, Collection& collection) {
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

// Reads every photograph once; one that cannot be used becomes a fault.
void FindPlates(const ExperimentOptions& options, Collection& collection) {
  std::vector<bool> bad(collection.photos.size(), false);
  for (std::size_t i = 0; i < collection.photos.size(); ++i) {
    Photo& photo = collection.photos[i];
    try {
      const GrayImage image = ReadGrayImage(photo.path);
      CheckSize(image, photo, collection);
      const BacklitPhoto flat = FlattenPhoto(image, options.threshold, photo.path.string());
      if (!options.frame) photo.edges = FindPlateEdges(flat, photo.path.string());
    } catch (const base::ConfigError& error) {
      collection.faults.push_back(error.what());
      bad[i] = true;
    }
  }
  collection.Drop(bad);
}

void CheckScale(Collection& collection) {
  std::vector<double> widths;
  for (const Photo& photo : collection.photos) widths.push_back(photo.edges.width);
  if (widths.empty()) return;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  const double median = *middle;
  std::vector<bool> bad(collection.photos.size(), false);
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const Photo& photo = collection.photos[i];
    if (std::abs(photo.edges.width - median) <= kSameScale * median) continue;
    std::ostringstream text;
    text.precision(4);
    text << photo.path.string() << ": its plate is " << photo.edges.width
         << " px wide, that of the other photographs " << median
         << " px; all must be taken at one scale: look at its overlay, take it again, give the "
            "plate's place with \"frame\", or leave it out";
    collection.faults.push_back(text.str());
    bad[i] = true;
  }
  collection.Drop(bad);
}

// Faults end the work, or are noted and left out.
void SettleFaults(const ExperimentOptions& options, Collection& collection, Experiment& result) {
  std::string all;
  for (const std::string& fault : collection.faults) all += (all.empty() ? "" : "\n") + fault;
  const std::string remedy = "\nput them right, or go on without them: --allow-missing-views";
  if (!all.empty() && !options.allow_missing_views) throw base::ConfigError(all + remedy);
  if (collection.photos.empty()) throw base::ConfigError(all + "\nno photograph is left");
  for (const std::string& fault : collection.faults) result.notes.push_back("left out: " + fault);
}

struct Placement {
  Frame frame;             // of the profiles
  double photo_pixel = 0;  // [m]
  std::vector<PlatePose> poses;
};

double MeanOver(const std::vector<PlatePose>& poses, double PlatePose::*part) {
  double sum = 0;
  for (const PlatePose& pose : poses) sum += pose.*part;
  return sum / static_cast<double>(poses.size());
}

// Centre and baseline on pixel borders, near where the photographs have them.
Frame FrameFor(const ExperimentOptions& options, const Collection& collection,
               const Placement& placement) {
  const double pixel = options.pixel_size.value_or(placement.photo_pixel);
  const double scale = pixel / placement.photo_pixel;
  return {.width = std::max(1, static_cast<int>(std::lround(collection.width / scale))),
          .height = std::max(1, static_cast<int>(std::lround(collection.height / scale))),
          .pixel_size = pixel,
          .center_x = std::round(MeanOver(placement.poses, &PlatePose::center_x) / scale),
          .baseline = std::round(MeanOver(placement.poses, &PlatePose::baseline) / scale),
          .plate_diameter = options.plate_diameter};
}

Placement PlaceByFrame(const ExperimentOptions& options, const Collection& collection) {
  const Frame& given = *options.frame;
  if (given.width != collection.width || given.height != collection.height) {
    throw base::ConfigError("frame: is " + Size(given.width, given.height) +
                            ", the photographs are " + Size(collection.width, collection.height) +
                            "; give width_px and height_px of the photographs");
  }
  Placement placement{.frame = given, .photo_pixel = given.pixel_size, .poses = {}};
  placement.poses.assign(collection.photos.size(),
                         {.width = given.plate_diameter / given.pixel_size,
                          .center_x = given.center_x,
                          .baseline = given.baseline,
                          .tilt = options.tilt});
  if (options.pixel_size) placement.frame = FrameFor(options, collection, placement);
  return placement;
}

Placement Place(const ExperimentOptions& options, const Collection& collection,
                Experiment& result) {
  if (options.frame) return PlaceByFrame(options, collection);
  std::vector<PhotographedPlate> plates;
  for (const Photo& photo : collection.photos) {
    plates.push_back({.edges = photo.edges, .run = photo.run});
  }
  PlateFit fit = FitPlates(plates);
  if (!fit.sharp_corners) {
    result.notes.push_back(
        "powder hides the plate's top in every photograph: the baseline is known to about a pixel");
  }
  Placement placement{.frame = {},
                      .photo_pixel = options.plate_diameter / fit.width,
                      .poses = std::move(fit.poses)};
  placement.frame = FrameFor(options, collection, placement);
  return placement;
}

MeasuredView MeasureView(const GrayImage& silhouette, const Photo& photo, const PlatePose& plate,
                         const Placement& placement, const ExperimentOptions& options) {
  return {.photo = photo.path,
          .plate = plate,
          .nebp = Nebp(silhouette),
          .angles = MeasureRepose(silhouette, placement.frame, options.metrics.repose)};
}

void MeasureRuns(const ExperimentOptions& options, const Collection& collection,
                 const Placement& placement, Experiment& result) {
  std::vector<std::vector<GrayImage>> silhouettes(collection.runs.size());
  for (const std::string& name : collection.runs) {
    result.runs.push_back({.name = name, .profile = {{}, placement.frame}, .views = {}});
  }
  for (std::size_t i = 0; i < collection.photos.size(); ++i) {
    const Photo& photo = collection.photos[i];
    const BacklitPhoto flat =
        FlattenPhoto(ReadGrayImage(photo.path), options.threshold, photo.path.string());
    GrayImage silhouette =
        MakeSilhouette(flat, placement.poses[i], placement.photo_pixel, placement.frame);
    MeasuredView view = MeasureView(silhouette, photo, placement.poses[i], placement, options);
    if (view.nebp == 0) {
      result.notes.push_back(photo.path.string() + ": no powder stands on the plate");
    }
    result.runs[photo.run].views.push_back(std::move(view));
    silhouettes[photo.run].push_back(std::move(silhouette));
  }
  for (std::size_t run = 0; run < result.runs.size(); ++run) {
    if (silhouettes[run].empty()) continue;
    result.runs[run].profile.image = MeanImage(silhouettes[run]);
  }
  std::erase_if(result.runs, [](const MeasuredRun& run) { return run.views.empty(); });
}

std::vector<GrayImage> RunImages(const Experiment& experiment) {
  std::vector<GrayImage> images;
  for (const MeasuredRun& run : experiment.runs) images.push_back(run.profile.image);
  return images;
}

GrayImage StandardDeviation(const std::vector<GrayImage>& images) {
  GrayImage result = images.front();
  const auto n = static_cast<double>(images.size());
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    double sum = 0, squares = 0;
    for (const GrayImage& image : images) {
      sum += image.pixels[i];
      squares += static_cast<double>(image.pixels[i]) * image.pixels[i];
    }
    const double variance = std::max(squares - sum * sum / n, 0.0) / (n - 1);
    result.pixels[i] = static_cast<std::uint8_t>(std::min(std::sqrt(variance), 255.0) + 0.5);
  }
  return result;
}

NoiseFloor LeaveOneOut(const std::vector<GrayImage>& images, const Profile& aehp) {
  NoiseFloor floor;
  for (std::size_t left = 0; left < images.size(); ++left) {
    std::vector<GrayImage> others = images;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    floor.sad_px.push_back(Sad(images[left], MeanImage(others)));
    floor.mean_sad_px += floor.sad_px.back() / static_cast<double>(images.size());
  }
  const double pixel = aehp.frame.pixel_size * 1e3;  // [mm]
  floor.mean_sad_mm2 = floor.mean_sad_px * pixel * pixel;
  floor.mean_sad_relative = floor.mean_sad_px / std::max(Nebp(aehp.image), 1e-300);
  return floor;
}

void Summarise(const ExperimentOptions& options, Experiment& result) {
  const std::vector<GrayImage> images = RunImages(result);
  if (images.size() >= 2) {
    result.standard_deviation = StandardDeviation(images);
    result.noise_floor = LeaveOneOut(images, result.aehp);
  }
  result.metrics = DescribeProfile(result.Images(), options.metrics);
}

}  // namespace

void ExperimentOptions::Validate(base::Problems& problems) const {
  const int sources = !photos.empty() + !runs.empty() + !map.empty();
  problems.Require(sources == 1, "", "needs exactly one of \"photos\", \"runs\" and \"map\"");
  problems.Require(plate_diameter > 0 && plate_diameter < 100, "plate_diameter", plate_diameter,
                   "must be positive and below 100 m");
  problems.Require(map_heaps >= 1, "map_heaps", map_heaps, "must be 1 or more");
  problems.Require(!pattern.empty(), "pattern", "must not be empty");
  problems.Require(std::abs(tilt) < 0.8, "tilt", tilt, "must be within ±0.8 rad");
  problems.Require(!pixel_size || (*pixel_size > 0 && *pixel_size < plate_diameter / 8),
                   "pixel_size", pixel_size.value_or(0),
                   "must be positive and below an eighth of the plate");
  problems.Require(!threshold || (*threshold > 0 && *threshold < 1), "threshold",
                   threshold.value_or(0), "must be in (0, 1)");
  for (const PhotoRun& run : runs) {
    problems.Require(!run.photos.empty(), "runs", "run \"" + run.name + "\" has no photographs");
  }
}

HeapImages Experiment::Images() const { return {.profile = aehp, .parts = RunImages(*this)}; }

Experiment MeasureExperiment(const ExperimentOptions& options) {
  base::Problems problems;
  options.Validate(problems);
  problems.ThrowIfAny();
  Experiment result;
  if (!options.map.empty()) {
    result.aehp = ReadMap(options.map, options.plate_diameter, options.frame);
  } else {
    Collection collection = Collect(options);
    FindPlates(options, collection);
    if (!options.frame) CheckScale(collection);
    SettleFaults(options, collection, result);
    const Placement placement = Place(options, collection, result);
    result.photo_pixel = placement.photo_pixel;
    MeasureRuns(options, collection, placement, result);
    result.aehp = {.image = MeanImage(RunImages(result)), .frame = placement.frame};
  }
  Summarise(options, result);
  return result;
}

}  // namespace talus::imaging
