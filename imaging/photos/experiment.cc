#include "imaging/photos/experiment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/map_file.h"
#include "imaging/photos/backlight.h"
#include "imaging/photos/photo_collection.h"
#include "imaging/photos/scale_mark.h"
#include "imaging/photos/silhouette.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace {

constexpr double kMostPixels = 20000;  // across the plate

std::string Size(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
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
Frame FrameFor(const ExperimentOptions& options, const PhotoCollection& collection,
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

Placement PlaceByFrame(const ExperimentOptions& options, const PhotoCollection& collection) {
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

// A heap on a table: its middle is where a plate's would be, and the table counts as far as
// `plate_diameter` says, or a little farther than the heap reaches.
Placement PlaceByScale(const ExperimentOptions& options, const PhotoCollection& collection) {
  constexpr double kBeyondHeap = 1.1;
  Placement placement{
      .frame = {}, .photo_pixel = ParseScale(options.scale).pixel_size(), .poses = {}};
  double reach = 0;  // [px]
  for (const Photo& photo : collection.photos) reach = std::max(reach, photo.table.reach);
  ExperimentOptions of = options;
  if (of.plate_diameter == 0) {
    of.plate_diameter = 1e-3 * std::ceil(1e3 * 2 * kBeyondHeap * reach * placement.photo_pixel);
  }
  for (const Photo& photo : collection.photos) {
    placement.poses.push_back({.width = of.plate_diameter / placement.photo_pixel,
                               .center_x = photo.table.center_x,
                               .baseline = photo.table.baseline,
                               .tilt = photo.table.tilt});
  }
  placement.frame = FrameFor(of, collection, placement);
  return placement;
}

Placement Place(const ExperimentOptions& options, const PhotoCollection& collection,
                Experiment& result) {
  if (options.frame) return PlaceByFrame(options, collection);
  if (!options.scale.empty()) return PlaceByScale(options, collection);
  std::vector<PhotographedPlate> plates;
  for (const Photo& photo : collection.photos) {
    plates.push_back({.edges = photo.edges, .run = photo.run});
  }
  PlateFit fit = FitPlates(plates);
  if (!fit.sharp_corners) {
    result.warnings.push_back({.doubt = PhotoDoubt::kHiddenTop});
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

void WarnOfView(const Photo& photo, const GrayImage& image, const GrayImage& silhouette,
                const Frame& frame, std::vector<PhotoWarning>& warnings) {
  const auto warn = [&](bool is_so, PhotoDoubt doubt, double value = 0) {
    if (is_so) warnings.push_back({.doubt = doubt, .photo = photo.path, .value = value});
  };
  const double beside = ShareBesidePlate(silhouette, frame);
  const double white = ShareOverexposed(image);
  warn(Nebp(silhouette) == 0, PhotoDoubt::kNoPowder);
  warn(TouchesFrame(silhouette), PhotoDoubt::kTouchesFrame);
  warn(beside > kMuchBesidePlate, PhotoDoubt::kBesidePlate, beside);
  warn(!photo.front_lit && white > kMuchOverexposed, PhotoDoubt::kOverexposed, white);
}

void WarnOfLight(const ExperimentOptions& options, const PhotoCollection& collection,
                 std::vector<PhotoWarning>& warnings) {
  if (options.powder != PowderLook::kAuto) return;
  const auto front_lit = std::count_if(collection.photos.begin(), collection.photos.end(),
                                       [](const Photo& photo) { return photo.front_lit; });
  if (front_lit == 0) return;
  const bool all = front_lit == static_cast<std::ptrdiff_t>(collection.photos.size());
  warnings.push_back({.doubt = all ? PhotoDoubt::kFrontLit : PhotoDoubt::kMixedLight,
                      .value = static_cast<double>(front_lit)});
}

void WarnOfDisagreement(const std::vector<MeasuredRun>& runs, std::vector<PhotoWarning>& warnings) {
  std::vector<double> nebp;
  std::vector<std::filesystem::path> photos;
  for (const MeasuredRun& run : runs) {
    for (const MeasuredView& view : run.views) {
      nebp.push_back(view.nebp);
      photos.push_back(view.photo);
    }
  }
  const std::vector<double> off = DisagreeingViews(nebp);
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (off[i] == 0) continue;
    warnings.push_back({.doubt = PhotoDoubt::kViewDisagrees, .photo = photos[i], .value = off[i]});
  }
}

struct MeasuredPhoto {
  MeasuredView view;
  GrayImage silhouette;
  std::vector<PhotoWarning> warnings;
};

MeasuredPhoto MeasurePhoto(Photo& photo, const PlatePose& pose, const Placement& placement,
                           const ExperimentOptions& options) {
  const GrayImage image =
      photo.image.pixels.empty() ? ReadGrayImage(photo.path) : std::exchange(photo.image, {});
  const BacklitPhoto flat = Flatten(options, image, photo.path);
  MeasuredPhoto measured;
  measured.silhouette = MakeSilhouette(flat, pose, placement.photo_pixel, placement.frame);
  measured.view = MeasureView(measured.silhouette, photo, pose, placement, options);
  WarnOfView(photo, image, measured.silhouette, placement.frame, measured.warnings);
  return measured;
}

void MeasureRuns(const ExperimentOptions& options, PhotoCollection& collection,
                 const Placement& placement, Experiment& result) {
  std::vector<std::vector<GrayImage>> silhouettes(collection.runs.size());
  for (const std::string& name : collection.runs) {
    result.runs.push_back({.name = name, .profile = {{}, placement.frame}, .views = {}});
  }
  std::vector<MeasuredPhoto> measured(collection.photos.size());
  ForEachPhoto(measured.size(), [&](std::size_t i) {
    measured[i] = MeasurePhoto(collection.photos[i], placement.poses[i], placement, options);
  });
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::size_t run = collection.photos[i].run;
    std::move(measured[i].warnings.begin(), measured[i].warnings.end(),
              std::back_inserter(result.warnings));
    result.runs[run].views.push_back(std::move(measured[i].view));
    silhouettes[run].push_back(std::move(measured[i].silhouette));
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
    const std::vector<double> off = DisagreeingRuns(result.noise_floor->sad_px);
    for (std::size_t i = 0; i < off.size(); ++i) {
      if (off[i] == 0) continue;
      result.warnings.push_back(
          {.doubt = PhotoDoubt::kRunDisagrees, .value = off[i], .reason = result.runs[i].name});
    }
  }
  result.metrics = DescribeProfile(result.Images(), options.metrics);
}

}  // namespace

void ExperimentOptions::Validate(base::Problems& problems) const {
  const int sources = !photos.empty() + !runs.empty() + !map.empty();
  problems.Require(sources == 1, "", "needs exactly one of \"photos\", \"runs\" and \"map\"");
  const bool as_wide_as_heap = !scale.empty() && plate_diameter == 0;
  problems.Require(as_wide_as_heap || (plate_diameter > 0 && plate_diameter <= 2), "plate_diameter",
                   plate_diameter, "must be positive and at most 2 m; write \"10 mm\" for 10 mm");
  problems.Require(map_heaps >= 1, "map_heaps", map_heaps, "must be 1 or more");
  problems.Require(!pattern.empty(), "pattern", "must not be empty");
  problems.Require(std::abs(tilt) < 0.8, "tilt", tilt, "must be within ±0.8 rad");
  problems.Require(
      !pixel_size || (*pixel_size > 0 && (as_wide_as_heap || *pixel_size < plate_diameter / 8)),
      "pixel_size", pixel_size.value_or(0), "must be positive and below an eighth of the plate");
  problems.Require(!pixel_size || *pixel_size >= plate_diameter / kMostPixels, "pixel_size",
                   pixel_size.value_or(0), "must be at least a 20000th of the plate");
  problems.Require(!threshold || (*threshold > 0 && *threshold < 1), "threshold",
                   threshold.value_or(0), "must be in (0, 1)");
  problems.Require(scale.empty() || (map.empty() && !frame), "scale",
                   "is of photographs of a heap on a table; leave it out with a map or a frame");
  try {
    if (!scale.empty()) ParseScale(scale);
  } catch (const base::ConfigError& error) {
    problems.Add("scale", error.what());
  }
  for (const PhotoRun& run : runs) {
    problems.Require(!run.photos.empty(), "runs", "run \"" + run.name + "\" has no photographs");
  }
}

HeapImages Experiment::Images() const { return {.profile = aehp, .parts = RunImages(*this)}; }

Experiment MeasureExperiment(const ExperimentOptions& options, const PictureSink& keep) {
  base::Problems problems;
  options.Validate(problems);
  problems.ThrowIfAny();
  Experiment result;
  if (!options.map.empty()) {
    result.aehp = ReadMap(options.map, options.plate_diameter, options.frame);
  } else {
    PhotoCollection collection = CollectPhotos(options, keep, result.warnings);
    WarnOfLight(options, collection, result.warnings);
    const Placement placement = Place(options, collection, result);
    result.photo_pixel = placement.photo_pixel;
    MeasureRuns(options, collection, placement, result);
    WarnOfDisagreement(result.runs, result.warnings);
    result.aehp = {.image = MeanImage(RunImages(result)), .frame = placement.frame};
  }
  Summarise(options, result);
  result.warnings = Gathered(result.warnings);
  return result;
}

}  // namespace talus::imaging
