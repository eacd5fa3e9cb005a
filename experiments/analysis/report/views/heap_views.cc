#include "experiments/analysis/report/views/heap_views.h"

#include <algorithm>

#include "base/error.h"
#include "experiments/analysis/compare/crop.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/trials/engines/command_result.h"
#include "imaging/formats/images/photograph_file.h"
#include "imaging/photos/overlay.h"
#include "imaging/photos/photo_set.h"
#include "imaging/spheres/projection.h"
#include "imaging/spheres/render.h"

namespace talus::analysis {
namespace {

constexpr int kRenderedWidth = 520;    // [px]
constexpr std::size_t kMostViews = 4;  // of a heap's photographs

// The grains of a trial; none where the folder or the file is gone, or it is damaged.
std::vector<base::Sphere> GrainsOf(const Evidence& evidence, int trial, LeftOut& left_out) {
  const auto folder = campaign::CampaignFolder{evidence.folder}.trial(trial);
  std::error_code absent;
  if (evidence.folder.empty() || !std::filesystem::exists(folder / rigs::kHeapFile, absent))
    return {};
  return ReadExtra(left_out, [&] { return trials::HeapOfTrial(folder); });
}

Eigen::VectorXd PointOf(const Evidence& evidence, const std::vector<double>& values) {
  Eigen::VectorXd point(static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    point[static_cast<Eigen::Index>(k)] =
        std::clamp(evidence.parameters[k].range.ToUnit(values[k]), 0.0, 1.0);
  }
  return point;
}

// Trials at the search's scale factor, and confirming ones, whose sets lie in the joint 90 %
// region: only the heap of a set that fits may stand for one.
std::vector<const TrialEvidence*> FittingTrials(const Evidence& evidence) {
  std::vector<const TrialEvidence*> trials;
  for (const TrialEvidence& trial : evidence.trials) {
    if (trial.state != journal::TrialStatus::kOk) continue;
    if (trial.scale_factor == evidence.scale_factor || trial.kind == journal::TrialKind::kConfirm) {
      trials.push_back(&trial);
    }
  }
  if (!evidence.model || trials.empty()) return trials;
  Eigen::MatrixXd points(static_cast<Eigen::Index>(trials.size()), trials.front()->point.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = trials[i]->point;
  }
  const Eigen::VectorXd levels = evidence.model->credible_levels(points);
  std::erase_if(trials, [&, i = Eigen::Index{0}](const TrialEvidence*) mutable {
    return levels[i++] > optimizer::kRegionLevel;
  });
  return trials;
}

void FindNearest(const std::vector<const TrialEvidence*>& trials, const Eigen::VectorXd& point,
                 RepresentativeView& view) {
  for (const TrialEvidence* trial : trials) {
    const double distance = (trial->point - point).lpNorm<Eigen::Infinity>();
    if (view.trial != nullptr && distance >= view.distance) continue;
    view.trial = trial;
    view.distance = distance;
  }
}

campaign::ExperimentSpec ExperimentOf(const Evidence& evidence) {
  const campaign::CampaignSpec spec = campaign::ParseSpecText(evidence.spec_json);
  return campaign::ExperimentsOf(spec).at(evidence.experiment);
}

bool HeapsOnPlate(const Evidence& evidence) {
  return rigs::IsRoundHeap(campaign::KindOf(ExperimentOf(evidence)));
}

imaging::Camera FrontOf(const std::vector<base::Sphere>& grains, int width) {
  constexpr double kMostHeight = 1.2;  // of the picture's width
  return imaging::FromTheFront(grains, width, kMostHeight);
}

imaging::ColorImage DrawnHeap(const Evidence& evidence, const std::vector<base::Sphere>& grains) {
  if (!HeapsOnPlate(evidence)) {
    return imaging::RenderSpheres(grains, FrontOf(grains, kRenderedWidth));
  }
  const double plate = evidence.reference.aehp.frame.plate_diameter;
  const auto on_plate = imaging::GrainsOnPlate(grains, plate);
  return imaging::RenderSpheres(on_plate, imaging::WholeHeap(on_plate, plate, kRenderedWidth));
}

// Without a PNG where there are no grains to draw.
Picture HeapOf(const Evidence& evidence, const TrialEvidence* trial, LeftOut& left_out) {
  if (trial == nullptr || !evidence.reference.has_image()) return {};
  const std::vector<base::Sphere> grains = GrainsOf(evidence, trial->id, left_out);
  if (grains.empty()) return {};
  return MakePicture({}, "Heap of trial " + std::to_string(trial->id), DrawnHeap(evidence, grains));
}

// The spec's photographs of one run: a camera's few views say enough.
imaging::ExperimentOptions FirstRun(imaging::ExperimentOptions options) {
  if (options.runs.empty()) {
    const imaging::PhotoSet set = imaging::FindPhotos(options.photos, options.pattern);
    options.photos.clear();
    options.runs.emplace_back();
    for (const imaging::PhotoFile& view : set.runs.front().views) {
      options.runs.front().photos.push_back(view.path);
    }
    options.runs.front().name = set.runs.front().run;
  }
  options.runs.resize(1);
  options.allow_missing_views = true;
  return options;
}

// Views spread evenly over those there are.
std::vector<imaging::MeasuredView> SomeViews(const std::vector<imaging::MeasuredView>& views) {
  std::vector<imaging::MeasuredView> some;
  const std::size_t count = std::min(views.size(), kMostViews);
  for (std::size_t i = 0; i < count; ++i) some.push_back(views[i * views.size() / count]);
  return some;
}

void AddPhotographs(const Evidence& evidence, const Box& box, PhotoOverlay& overlay) {
  const campaign::ExperimentSpec experiment = ExperimentOf(evidence);
  if (campaign::ShowsDrum(experiment)) {
    throw base::ConfigError("a drum's photographs count as one average");
  }
  const imaging::ExperimentOptions& given = experiment.images;
  if (!given.map.empty()) throw base::ConfigError("the experiment is given as a map");
  const imaging::ExperimentOptions options = FirstRun(given);
  const imaging::Experiment measured = imaging::MeasureExperiment(options);
  for (const imaging::MeasuredView& view : SomeViews(measured.runs.front().views)) {
    const imaging::GrayImage photo =
        imaging::PhotoInFrame(imaging::ReadPhotograph(view.photo).image, view.plate,
                              measured.photo_pixel, evidence.reference.aehp.frame);
    overlay.photographs.push_back(
        MakePicture("photograph_" + std::to_string(overlay.photographs.size() + 1),
                    view.photo.filename().string(), Cropped(photo, box)));
  }
}

imaging::Camera CameraOf(const imaging::Frame& frame, const Box& box) {
  return {.width = box.width,
          .height = box.height,
          .pixel_size = frame.pixel_size,
          .center_x = frame.center_x - box.left,
          .baseline = frame.baseline - box.top,
          .plate_diameter = frame.plate_diameter};
}

// As the photographs show the grains.
imaging::ColorImage SeenBy(imaging::Camera camera, const Evidence& evidence,
                           const std::vector<base::Sphere>& grains) {
  if (HeapsOnPlate(evidence)) {
    return imaging::RenderSpheres(imaging::GrainsOnPlate(grains, camera.plate_diameter), camera);
  }
  camera.plate_diameter = 0;
  return imaging::RenderSpheres(grains, camera);
}

}  // namespace

std::vector<RepresentativeView> RepresentativeViews(const Evidence& evidence, LeftOut& left_out) {
  std::vector<RepresentativeView> views;
  if (!evidence.answer) return views;
  std::vector<double> recommended;
  for (const campaign::ResultParameter& p : evidence.answer->parameters) {
    recommended.push_back(p.value);
  }
  std::vector<std::vector<double>> sets = evidence.answer->representative;
  if (sets.empty()) sets.push_back(recommended);
  const std::vector<const TrialEvidence*> trials = FittingTrials(evidence);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    RepresentativeView view{
        .values = sets[i], .is_recommended = sets[i] == recommended, .heap = {}};
    const Eigen::VectorXd point = PointOf(evidence, sets[i]);
    if (evidence.model && evidence.model->predict) {
      const optimizer::Moments at = evidence.model->predict(point.transpose());
      view.expected = at.mean[0];
      view.expected_sd = at.sd[0];
    }
    FindNearest(trials, point, view);
    view.heap = HeapOf(evidence, view.trial, left_out);
    view.heap.name = "heap_" + std::to_string(i + 1);
    views.push_back(std::move(view));
  }
  return views;
}

PhotoOverlay MakeOverlay(const Evidence& evidence, const TrialEvidence* best, LeftOut& left_out) {
  PhotoOverlay overlay{.photographs = {}, .simulated = {}};
  if (best == nullptr || !evidence.reference.has_image()) return overlay;
  overlay.trial = best;
  if (const TrialEvidence* confirming = ConfirmingTrial(evidence)) overlay.trial = confirming;
  const std::vector<base::Sphere> grains = GrainsOf(evidence, overlay.trial->id, left_out);
  const auto profile = evidence.profile(overlay.trial->id);
  if (grains.empty() || !profile) return overlay;
  const imaging::Frame& frame = evidence.reference.aehp.frame;
  if (frame.num_pictures() > 1) {
    overlay.absent = "of a film there is no simulated heap but the last";
    return overlay;
  }
  const Box box = HeapBox({&evidence.reference.aehp, &*profile});
  const imaging::Camera camera = CameraOf(frame, box);
  overlay.pixel_mm = 1e3 * frame.pixel_size;
  overlay.center_x = camera.center_x;
  overlay.baseline = camera.baseline;
  overlay.simulated =
      MakePicture("simulated_beside_photograph", "trial " + std::to_string(overlay.trial->id),
                  SeenBy(camera, evidence, grains));
  try {
    AddPhotographs(evidence, box, overlay);
  } catch (const base::ConfigError& error) {  // moved or renamed since: the report goes without
    overlay.absent = error.what();
  }
  return overlay;
}

}  // namespace talus::analysis
