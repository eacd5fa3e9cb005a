#include "experiments/campaign/spec/drum_images.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.h"
#include "imaging/drums/drum.h"
#include "imaging/photos/photo_set.h"

namespace talus::campaign {
namespace {

imaging::MeasuredDrum MeasureDrumOf(const ExperimentSpec& e) {
  imaging::DrumPhotos drum{.photos = {},
                           .diameter = e.images.plate_diameter,
                           .circle_diameter = e.circle_diameter,
                           .turning = e.turning};
  if (e.images.photos.empty()) {
    drum.photos = {e.images.map};
  } else {
    drum.photos = imaging::ImagesIn(e.images.photos);
    if (drum.photos.empty()) {
      throw base::ConfigError(e.images.photos.string() + ": holds no photographs");
    }
  }
  return imaging::MeasureDrum(drum);
}

// Photographs that are not taken yet need not keep the cost from being planned; a campaign asks for
// them when it begins.
constexpr double kPlannedFill = 0.5;

bool AreThere(const ExperimentSpec& e) {
  return std::filesystem::exists(e.images.photos.empty() ? e.images.map : e.images.photos);
}

// Whether the circle that is given can be that of a ring around the drum.
bool IsAroundDrum(const ExperimentSpec& e) {
  const double drum = e.rig->drum.diameter;
  return !e.circle_diameter || (*e.circle_diameter >= drum && *e.circle_diameter <= 2 * drum);
}

// A drum's photographs are then made binary, too.
bool ShowsAny(const ExperimentSpec& e) {
  return IsDrum(e.rig) && e.rig->camera && e.rig->camera->shows == rigs::Shown::kAny;
}

// Powder where the map, 0 powder in every picture and 255 in none, is darker than the share.
void MakeBinary(double share, imaging::GrayImage& image) {
  for (std::uint8_t& level : image.pixels) level = level < 255 * share ? 0 : 255;
}

// Photographs of a camera that shows any powder are averages made binary.
void RequireThreshold(const ExperimentSpec& e, const std::string& prefix,
                      base::Problems& problems) {
  problems.Require(e.images.threshold || !ShowsAny(e), prefix + "threshold",
                   "is missing: the camera shows powder where any picture has it, so say below "
                   "which share of the light the photographs' average is powder, such as 0.9");
}

double FillIn(const ExperimentSpec& e) {
  const imaging::Measured fill = MeasureDrumOf(e).surface.fill;
  if (fill.defined()) return fill.value;
  throw base::ConfigError((e.images.map.empty() ? e.images.photos : e.images.map).string() +
                          ": shows no fill: " + fill.not_defined +
                          "; give rig.fill or the powder's mass");
}

// A collapsed column lies beyond its own length, which is the width of its images.
imaging::ExperimentOptions WithGround(const ExperimentSpec& e) {
  imaging::ExperimentOptions images = e.images;
  if (e.rig && e.rig->kind == rigs::RigKind::kColumnCollapse) {
    images.ground = imaging::Ground::kFloor;
  }
  return images;
}

}  // namespace

bool IsDrum(const std::optional<rigs::RigOptions>& rig) {
  return rigs::KindOf(rig) == rigs::RigKind::kDrum;
}

bool HasFill(const ExperimentSpec& e) { return IsDrum(e.rig) && e.rig->drum.fill; }

bool ShowsDrum(const ExperimentSpec& e) {
  return IsDrum(e.rig) && e.images.HasImages() && !e.images.frame;
}

void ValidateDrumImages(const ExperimentSpec& e, const std::string& place,
                        base::Problems& problems) {
  const std::string prefix = place.empty() ? "" : place + ".";
  if (!ShowsDrum(e)) {
    problems.Require(!e.turning, prefix + "turning", "is of a drum's photographs: remove it");
    problems.Require(!e.circle_diameter, prefix + "circle_diameter",
                     "is of a drum's photographs: remove it");
    problems.Require(IsDrum(e.rig) || !e.images.frame || !e.images.frame->disc_diameter,
                     prefix + "frame.disc_diameter", "is of a drum's picture: remove it");
    problems.Require(!e.images.threshold || e.images.map.empty() || ShowsAny(e),
                     prefix + "threshold",
                     "is of photographs: in a map grey tells how often powder is there");
    if (e.images.HasImages()) RequireThreshold(e, prefix, problems);
    return;
  }
  problems.Require(IsAroundDrum(e), prefix + "circle_diameter", e.circle_diameter.value_or(0),
                   "must be from the rig's diameter to twice that: it is the outside of the ring");
  const imaging::ExperimentOptions& images = e.images;
  problems.Require(
      !images.film, prefix + "film",
      "of a drum needs a \"frame\": its pictures are maps in one frame, each an average "
      "as `talus measure --drum` writes it");
  problems.Require(images.runs.empty(), prefix + "runs",
                   "are of heaps: give a drum's photographs as the folder of one series, "
                   "\"photos\", or as their average, \"map\"");
  const bool plain = images.scale.empty() && images.pattern.empty() && images.tilt == 0 &&
                     !images.pixel_size && images.powder != imaging::PowderLook::kBright &&
                     (!images.threshold || ShowsAny(e));
  problems.Require(plain, place,
                   "has a scale, pattern, tilt, pixel_size, threshold or bright powder, which are "
                   "of heaps: a drum is read by its circle, lit from behind, from all pictures of "
                   "the folder");
  RequireThreshold(e, prefix, problems);
}

imaging::Experiment MeasureImages(const ExperimentSpec& e) {
  if (!ShowsDrum(e) && !ShowsAny(e)) return imaging::MeasureExperiment(WithGround(e));
  imaging::Experiment experiment;
  if (ShowsDrum(e)) {
    experiment.aehp = imaging::DrumProfile(MeasureDrumOf(e));
  } else {
    experiment = imaging::MeasureExperiment(e.images);
  }
  if (ShowsAny(e)) MakeBinary(e.images.threshold.value(), experiment.aehp.image);
  experiment.metrics = imaging::DescribeProfile(experiment.Images(), e.images.metrics);
  return experiment;
}

std::string ReadingText(const ExperimentSpec& e) {
  const bool has_photos = !e.images.photos.empty() || !e.images.runs.empty();
  if (!has_photos || ShowsDrum(e)) return "";
  return imaging::ReadingText(imaging::NamePhotos(e.images));
}

std::vector<std::string> ReadingTexts(const std::vector<ExperimentSpec>& experiments) {
  std::vector<std::string> texts;
  for (const ExperimentSpec& e : experiments) {
    const std::string reading = ReadingText(e);
    if (!reading.empty()) texts.push_back("photographs of " + e.name + ": " + reading);
  }
  return texts;
}

void SetDrumDiameter(const std::optional<rigs::RigOptions>& rig,
                     imaging::ExperimentOptions& images) {
  if (!IsDrum(rig) || !images.HasImages() || images.plate_diameter != 0) return;
  images.plate_diameter = rig->drum.diameter;
}

void SetDrumDiameters(CampaignSpec& spec) {
  if (spec.experiment) SetDrumDiameter(spec.rig, *spec.experiment);
  if (!spec.experiments) return;
  for (ExperimentSpec& e : *spec.experiments) {
    SetDrumDiameter(e.rig ? e.rig : spec.rig, e.images);
  }
}

void SetDrumFills(CampaignSpec& spec) {
  if (spec.parameters && (spec.parameters->fill || spec.parameters->mass)) return;
  const std::vector<ExperimentSpec> all = ExperimentsOf(spec);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!ShowsDrum(all[i]) || all[i].mass || HasFill(all[i]) || !IsAroundDrum(all[i])) continue;
    rigs::RigOptions rig = *all[i].rig;
    rig.drum.fill = AreThere(all[i]) ? FillIn(all[i]) : kPlannedFill;
    (spec.experiment ? spec.rig : (*spec.experiments)[i].rig) = std::move(rig);
  }
}

}  // namespace talus::campaign
