#include "imaging/photos/experiment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/text/number_text.h"
#include "base/units.h"
#include "imaging/formats/images/map_file.h"
#include "imaging/photos/copied_photos.h"
#include "imaging/photos/film.h"
#include "imaging/photos/heap_breaks.h"
#include "imaging/photos/measured_runs.h"
#include "imaging/photos/photo_collection.h"
#include "imaging/photos/photo_reading.h"
#include "imaging/photos/photo_set.h"
#include "imaging/photos/placement.h"
#include "imaging/photos/sad_from_others.h"
#include "imaging/photos/scale_mark.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace {

constexpr double kMostPixels = 20000;                  // across the plate
constexpr double kMostPlateTilt = 10 * base::kDegree;  // of the plate [rad]

// Where nobody has named a pattern that leaves them out.
void WarnOfUnread(const ExperimentOptions& options, const PhotoSet& set,
                  std::vector<PhotoWarning>& warnings) {
  if (!options.runs.empty() || !options.pattern.empty()) return;
  const std::string unread = UnreadText(options.photos, set);
  if (!unread.empty()) warnings.push_back({.doubt = PhotoDoubt::kUnread, .reason = unread});
}

void WarnOfViews(const std::vector<MeasuredRun>& runs, std::vector<PhotoWarning>& warnings) {
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

// None where the tilt was given.
std::optional<PhotoWarning> DoubtOfTilt(const ExperimentOptions& options,
                                        const PhotoCollection& collection,
                                        const Placement& placement) {
  if (options.frame || placement.poses.empty()) return std::nullopt;
  const auto tilt = [](const PlatePose& pose) { return std::abs(pose.tilt); };
  const auto most = std::ranges::max_element(placement.poses, {}, tilt);
  if (tilt(*most) <= kMuchTilted) return std::nullopt;
  const auto photo = static_cast<std::size_t>(most - placement.poses.begin());
  return PhotoWarning{
      .doubt = PhotoDoubt::kTilted, .photo = collection.photos[photo].path, .value = tilt(*most)};
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
  NoiseFloor floor{.sad_px = SadFromOthers(images)};
  for (const double sad : floor.sad_px) {
    floor.mean_sad_px += sad / static_cast<double>(images.size());
  }
  const double pixel = aehp.frame.pixel_size * 1e3;  // [mm]
  floor.mean_sad_mm2 = floor.mean_sad_px * pixel * pixel;
  floor.mean_sad_relative = floor.mean_sad_px / std::max(Nebp(aehp.image), 1e-300);
  return floor;
}

// Columns that show powder.
double NumColumns(const GrayImage& image) {
  double count = 0;
  for (int x = 0; x < image.width; ++x) {
    for (int y = 0; y < image.height; ++y) {
      if (image.at(x, y) > 127) continue;
      count += 1;
      break;
    }
  }
  return count;
}

// The same camera sees the same heap again to some hundredths of a pixel. Copies are warned of
// by themselves.
void WarnOfNoNoise(Experiment& result) {
  constexpr double kLeast = 0.01;                        // of the outline's place [px]
  const double outline = NumColumns(result.aehp.image);  // none is shorter [px]
  const double noise = result.noise_floor->mean_sad_px / std::max(outline, 1.0);
  const bool has_copies =
      std::ranges::count(result.warnings, PhotoDoubt::kCopied, &PhotoWarning::doubt) > 0;
  if (noise >= kLeast || has_copies || Nebp(result.aehp.image) == 0) return;
  result.warnings.push_back({.doubt = PhotoDoubt::kNoNoise, .value = noise});
}

// What the runs say of each other.
void CompareRuns(Experiment& result) {
  const std::vector<GrayImage> images = RunImages(result);
  if (images.size() < 2) return;
  result.standard_deviation = StandardDeviation(images);
  result.noise_floor = LeaveOneOut(images, result.aehp);
  WarnOfNoNoise(result);
  const std::vector<double> off = DisagreeingRuns(result.noise_floor->sad_px);
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (off[i] == 0) continue;
    result.warnings.push_back(
        {.doubt = PhotoDoubt::kRunDisagrees, .value = off[i], .reason = result.runs[i].name});
  }
}

PhotoSet Without(PhotoSet set, const std::vector<UnusablePhoto>& left_out) {
  const auto is_out = [&](const PhotoFile& view) {
    return std::ranges::find(left_out, view.path, &UnusablePhoto::photo) != left_out.end();
  };
  for (PhotoFiles& run : set.runs) std::erase_if(run.views, is_out);
  std::erase_if(set.runs, [](const PhotoFiles& run) { return run.views.empty(); });
  return set;
}

void MeasurePhotographs(const ExperimentOptions& options, Experiment& result) {
  const PhotoSet set = NamePhotos(options);
  std::vector<Photo> photos = ReadPhotos(options, set);
  PhotoCollection collection = CollectPhotos(options, set, std::move(photos));
  result.left_out = std::move(collection.left_out);
  result.reading = ReadingText(Without(set, result.left_out));
  result.warnings = std::move(collection.warnings);
  WarnOfUnread(options, set, result.warnings);
  const Placement placement = Place(options, collection);
  if (placement.hidden_top) result.warnings.push_back({.doubt = PhotoDoubt::kHiddenTop});
  if (auto doubt = DoubtOfTilt(options, collection, placement)) {
    result.warnings.push_back(std::move(*doubt));
  }
  if (placement.unseen > 0) {
    result.warnings.push_back({.doubt = PhotoDoubt::kBeyondPicture, .value = placement.unseen});
  }
  result.photo_pixel = placement.photo_pixel;
  result.runs = MeasureRuns(options, placement, collection, result.warnings);
  result.aehp = {.image = MeanImage(RunImages(result)), .frame = placement.frame};
  for (const MeasuredRun& run : result.runs) {
    if (auto doubt = DoubtOfOneHeap(run)) result.warnings.push_back(std::move(*doubt));
  }
  WarnOfViews(result.runs, result.warnings);
  std::ranges::move(WarningsOfCopies(result.runs), std::back_inserter(result.warnings));
}

Experiment MeasureFilm(const ExperimentOptions& options) {
  std::vector<Experiment> pictures;
  for (const FilmedPicture& picture : *options.film) {
    pictures.push_back(MeasureExperiment(OptionsAt(options, picture)));
  }
  return JoinedFilm(pictures);
}

// Else no heap would have an RMSE.
void RequireWithin(const std::optional<Region>& region, const Frame& frame) {
  if (!region || region->IsWithin(frame)) return;
  throw base::ConfigError("metrics.rmse_region: is not within the profiles of " +
                          std::to_string(frame.picture_width()) + " x " +
                          std::to_string(frame.height) + " px");
}

}  // namespace

void FilmedPicture::Validate(base::Problems& problems) const {
  problems.Require(!photos.empty() + !runs.empty() + !map.empty() == 1, "",
                   "needs exactly one of \"photos\", \"runs\" and \"map\"");
}

namespace {

// A map has no photographs, and photographs need no number of heaps.
void RefuseKeysOfOtherSources(const ExperimentOptions& e, base::Problems& problems) {
  const auto is_of_map = [](const FilmedPicture& picture) { return !picture.map.empty(); };
  const bool is_map = !e.map.empty() || (e.film && std::ranges::all_of(*e.film, is_of_map));
  problems.Require(e.map_heaps == 1 || is_map, "map_heaps", e.map_heaps,
                   "is of a map; photographs tell their heaps by their names");
  problems.Require(e.pattern.empty() || !is_map, "pattern",
                   "is of the photographs in a folder, not of a map: remove it");
  problems.Require(e.powder == PowderLook::kAuto || !is_map, "powder",
                   "is of photographs: in a map black means powder");
  problems.Require(!e.allow_missing_views || !is_map, "allow_missing_views",
                   "is of photographs, not of a map: remove it");
}

void ValidateRuns(const std::vector<PhotoRun>& runs, base::Problems& problems) {
  std::set<std::string> names;
  for (const PhotoRun& run : runs) {
    problems.Require(!run.photos.empty(), "runs", "run \"" + run.name + "\" has no photographs");
    problems.Require(names.insert(run.name).second, "runs",
                     "run \"" + run.name + "\" stands there twice: give each heap its own name");
  }
}

}  // namespace

void ExperimentOptions::Validate(base::Problems& problems) const {
  const int sources = !photos.empty() + !runs.empty() + !map.empty() + film.has_value();
  problems.Require(sources == 1, "",
                   "needs exactly one of \"photos\", \"runs\", \"map\" and \"film\"");
  problems.Require(!film || !film->empty(), "film", "is empty: give a picture for each time");
  problems.Require(!frame || !frame->pictures || !map.empty(), "frame.pictures",
                   "is of a map that shows a whole film: remove it");
  const bool as_wide_as_heap = !scale.empty() && plate_diameter == 0;
  problems.Require(as_wide_as_heap || (plate_diameter > 0 && plate_diameter <= 2), "plate_diameter",
                   plate_diameter, "must be positive and at most 2 m; write \"10 mm\" for 10 mm");
  problems.Require(
      !frame || std::abs(frame->plate_diameter - plate_diameter) <= 1e-6 * frame->plate_diameter,
      "plate_diameter", plate_diameter, "is another than that of \"frame\"; they are of one plate");
  RefuseKeysOfOtherSources(*this, problems);
  problems.Require(tilt == 0 || frame.has_value(), "tilt", tilt,
                   "is of a plate that \"frame\" gives; else it is found");
  problems.Require(map_heaps >= 1, "map_heaps", map_heaps, "must be 1 or more");
  problems.Require(std::abs(tilt) <= kMostPlateTilt, "tilt", tilt,
                   "in rad, which is " + base::ShortNumber(tilt / base::kDegree) +
                       " degrees, and must be within ±10: turn the photographs, or, if " +
                       base::ShortNumber(tilt) + " degrees are meant, write \"" +
                       base::ShortNumber(tilt) + " deg\"");
  problems.Require(!pixel_size || (*pixel_size > 0 &&
                                   (!(plate_diameter > 0) || *pixel_size < plate_diameter / 8)),
                   "pixel_size", pixel_size.value_or(0),
                   "must be positive and below an eighth of the plate; write \"30 um\" for 30 um");
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
  ValidateRuns(runs, problems);
}

HeapImages Experiment::Images() const { return {.profile = aehp, .parts = RunImages(*this)}; }

Experiment MeasureExperiment(const ExperimentOptions& options) {
  base::Problems problems;
  options.Validate(problems);
  problems.ThrowIfAny();
  Experiment result;
  if (options.film) {
    result = MeasureFilm(options);
  } else if (options.map.empty()) {
    MeasurePhotographs(options, result);
  } else {
    result.aehp = ReadMap(options.map, options.plate_diameter, options.frame);
  }
  RequireWithin(options.metrics.rmse_region, result.aehp.frame);
  CompareRuns(result);
  result.metrics = DescribeProfile(result.Images(), options.metrics);
  result.warnings = Gathered(result.warnings);
  return result;
}

}  // namespace talus::imaging
