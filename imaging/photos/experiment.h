// From an experiment's photographs, or a map someone has made of them, to the AEHP.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/field.h"
#include "base/problems.h"
#include "imaging/heap/metrics.h"
#include "imaging/heap/profile.h"
#include "imaging/light/backlight.h"
#include "imaging/photos/ground.h"
#include "imaging/photos/photo_warning.h"
#include "imaging/photos/plate/plate_fit.h"

namespace talus::imaging {

// The photographs of one heap, one a view.
struct PhotoRun {
  std::string name;
  std::vector<std::filesystem::path> photos;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "what messages and tables call the run"});
    visit("photos", self.photos, {.required = true, .doc = "its photographs, one a view"});
  }
};

// The photographs of one of a film's times: exactly one of these.
struct FilmedPicture {
  std::filesystem::path photos;
  std::vector<PhotoRun> runs;
  std::filesystem::path map;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("photos", self.photos, {.doc = "folder with the photographs of this time"});
    visit("runs", self.runs, {.doc = "the photographs of each run, instead of `photos`"});
    visit("map", self.map, {.doc = "a grey average map (black = powder), instead of photographs"});
  }
  void Validate(base::Problems& problems) const;
};

// Exactly one of `photos`, `runs`, `map` and `film` says where the images are.
struct ExperimentOptions {
  std::filesystem::path photos;  // folder
  std::string pattern;  // of the file names in it, or that `runs` were told by; empty: what fits
  std::vector<PhotoRun> runs;                        // or the photographs one by one
  std::filesystem::path map;                         // or the grey average, black = powder
  std::optional<std::vector<FilmedPicture>> film{};  // or those of several times of one run
  int map_heaps = 1;                                 // so many heaps the map is the average of, > 0
  double plate_diameter = 0;   // [m], > 0; with `scale` 0: as wide as the heap
  std::string scale;           // ParseScale: a heap on a table, no plate
  std::optional<Frame> frame;  // where the plate is, instead of finding it
  double tilt = 0;             // of the plate, with `frame` [rad], > 0 if its right end is lower
  std::optional<double> pixel_size;  // of the profiles [m]; as photographed without it
  std::optional<double> threshold;   // darker than this share of the background is powder, in (0,
                                     // 1); found by Otsu's method without it
  PowderLook powder = PowderLook::kAuto;
  bool allow_missing_views = false;  // go on without views that are missing or unusable
  MetricOptions metrics;
  Ground ground = Ground::kPlate;  // no key: it follows from the test

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("photos", self.photos, {.doc = "folder with the photographs"});
    visit("pattern", self.pattern,
          {.doc = "file names in `photos`: {run} and {view} stand for numbers or words, * for "
                  "anything; default: the one that fits"});
    visit("runs", self.runs, {.doc = "the photographs of each run, instead of `photos`"});
    visit("map", self.map, {.doc = "a grey average map (black = powder), instead of photographs"});
    visit("film", self.film,
          {.doc = "instead of one image those of several times of a run, first to last: for each "
                  "its photos, runs or map"});
    visit("map_heaps", self.map_heaps,
          {.doc = "of how many heaps (runs, not views) the map is the average, 1 or more: what is "
                  "not known of the mean heap widens the credible ranges"});
    visit("plate_diameter", self.plate_diameter,
          {.dimension = Dimension::kLength, .doc = "plate diameter, > 0; needed with images"});
    visit("scale", self.scale,
          {.doc =
               "of a heap on a table without a plate: two points of a photograph in pixels and the "
               "length between them, \"104,310-884,312 = 30 mm\"; plate_diameter is then the part "
               "of the table that counts"});
    visit("frame", self.frame, {.doc = "where the plate is, instead of finding it in the images"});
    visit("tilt", self.tilt,
          {.dimension = Dimension::kAngle,
           .doc = "with `frame`: tilt of the plate, > 0 if its right end is lower"});
    visit("pixel_size", self.pixel_size,
          {.dimension = Dimension::kLength,
           .doc = "pixel size of the profiles; as photographed without it"});
    visit("threshold", self.threshold,
          {.doc = "darker than this share of the background is powder, in (0, 1); found by Otsu's "
                  "method without it"});
    visit("powder", self.powder,
          {.doc = "how powder looks before its background: \"dark\" (lit from behind), \"bright\" "
                  "(lit from the front), or \"auto\", which looks at the picture's border"});
    visit("allow_missing_views", self.allow_missing_views,
          {.doc = "go on without views that are missing or unusable"});
    visit("metrics", self.metrics, {.doc = "how the profiles are measured"});
  }
  void Validate(base::Problems& problems) const;
  // Whether it names images at all.
  bool HasImages() const { return !photos.empty() || !runs.empty() || !map.empty() || film; }
  // Pictures of one run: those of a film, or one.
  int num_pictures() const {
    return film ? static_cast<int>(film->size()) : frame ? frame->num_pictures() : 1;
  }
  LightOptions light() const {
    return {.threshold = threshold, .powder = powder, .table = !scale.empty()};
  }
};

// A photograph that cannot be used, and what was found of its plate.
struct UnusablePhoto {
  std::filesystem::path photo;
  PlateEdges edges;
  std::string fault;         // names the file
  bool is_drawable = false;  // FaultOf can show what was found in it
};

struct MeasuredView {
  std::filesystem::path photo;
  PlatePose plate;                      // of this photograph
  double nebp = 0;                      // [px] of the AEHP's frame
  double step = 0;                      // SAD to the view before it in its run [px], 0 of the first
  std::optional<std::int64_t> taken{};  // by the camera's clock [s]
  ReposeAngles angles;                  // of this silhouette
};

struct MeasuredRun {
  std::string name;
  Profile profile;  // mean of its views
  std::vector<MeasuredView> views;
};

// The difference between one heap and the mean of the others: noise from run to run.
struct NoiseFloor {
  std::vector<double> sad_px;  // a run: SAD of its profile and the mean of the others
  double mean_sad_px = 0;
  double mean_sad_mm2 = 0;
  double mean_sad_relative = 0;  // / NEBP of the AEHP
};

struct Experiment {
  Profile aehp;                           // of a film its strip (film_strip.h), as of each run
  double photo_pixel = 0;                 // pixel size of the photographs [m], 0 for a map
  std::string reading;                    // how the names were read; empty for a map
  std::vector<MeasuredRun> runs;          // none for a map
  GrayImage standard_deviation;           // over the runs [grey levels], empty for fewer than two
  std::optional<NoiseFloor> noise_floor;  // for two runs or more
  std::vector<Metric> metrics;            // DescribeProfile of the AEHP; errors from run to run
  std::vector<PhotoWarning> warnings;     // what was left out or is doubtful
  std::vector<UnusablePhoto> left_out;    // with `allow_missing_views`

  // The AEHP with its runs as parts: what CompareProfiles takes as reference.
  HeapImages Images() const;
};

// Some photographs cannot be used; what() lists the faults and what to do.
class UnusablePhotosError : public base::ConfigError {
 public:
  UnusablePhotosError(const std::string& text, std::vector<UnusablePhoto> photos)
      : ConfigError(text), photos_(std::move(photos)) {}
  const std::vector<UnusablePhoto>& photos() const { return photos_; }

 private:
  std::vector<UnusablePhoto> photos_;
};

// Throws ConfigError that names the file and what to do; UnusablePhotosError for faults of
// photographs that could be left out.
Experiment MeasureExperiment(const ExperimentOptions& options);

}  // namespace talus::imaging
