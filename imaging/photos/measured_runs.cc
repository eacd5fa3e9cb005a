#include "imaging/photos/measured_runs.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "base/parallel_for.h"
#include "imaging/formats/images/photograph_file.h"
#include "imaging/photos/silhouette.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace {

// The photograph made independent of its light: as it was kept, else read again.
BacklitPhoto TakeFlat(const ExperimentOptions& options, Photo& photo) {
  if (!photo.flat.image.pixels.empty()) return std::exchange(photo.flat, {});
  return FlattenPhoto(ReadPhotograph(photo.path).image, options.light(), photo.path.string());
}

struct MeasuredPhoto {
  MeasuredView view;
  GrayImage silhouette;
  std::vector<PhotoWarning> warnings;
};

MeasuredPhoto MeasurePhoto(const ExperimentOptions& options, const Placement& placement,
                           const PlatePose& pose, Photo& photo) {
  const BacklitPhoto flat = TakeFlat(options, photo);
  GrayImage silhouette =
      MakeSilhouette(flat, pose, placement.photo_pixel, placement.frame, options.ground);
  const double nebp = Nebp(silhouette);
  const bool reaches_border =
      ReachesBorder(silhouette, flat, pose, placement.photo_pixel, placement.frame);
  MeasuredView view{.photo = photo.path,
                    .plate = pose,
                    .nebp = nebp,
                    .taken = photo.taken,
                    .angles = MeasureRepose(silhouette, placement.frame, options.metrics.repose)};
  std::vector<PhotoWarning> warnings = WarningsOf({.photo = photo.path,
                                                   .silhouette = silhouette,
                                                   .nebp = nebp,
                                                   .frame = placement.frame,
                                                   .ground = options.ground,
                                                   .overexposed = photo.overexposed,
                                                   .reaches_border = reaches_border});
  return {std::move(view), std::move(silhouette), std::move(warnings)};
}

}  // namespace

std::vector<MeasuredRun> MeasureRuns(const ExperimentOptions& options, const Placement& placement,
                                     PhotoCollection& collection,
                                     std::vector<PhotoWarning>& warnings) {
  std::vector<MeasuredPhoto> measured(collection.photos.size());
  const auto measure = [&](std::int64_t item) {
    const auto i = static_cast<std::size_t>(item);
    measured[i] = MeasurePhoto(options, placement, placement.poses[i], collection.photos[i]);
  };
  base::ParallelFor({.num_items = std::ssize(measured), .item_work = kPhotoWork}, measure);
  std::vector<MeasuredRun> runs;
  std::vector<std::vector<GrayImage>> silhouettes(collection.runs.size());
  for (const std::string& name : collection.runs) {
    runs.push_back({.name = name, .profile = {{}, placement.frame}, .views = {}});
  }
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::size_t run = collection.photos[i].run;
    std::move(measured[i].warnings.begin(), measured[i].warnings.end(),
              std::back_inserter(warnings));
    MeasuredView& view = runs[run].views.emplace_back(std::move(measured[i].view));
    if (!silhouettes[run].empty()) {
      view.step = Sad(silhouettes[run].back(), measured[i].silhouette);
    }
    silhouettes[run].push_back(std::move(measured[i].silhouette));
  }
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (!silhouettes[run].empty()) runs[run].profile.image = MeanImage(silhouettes[run]);
  }
  std::erase_if(runs, [](const MeasuredRun& run) { return run.views.empty(); });
  return runs;
}

}  // namespace talus::imaging
