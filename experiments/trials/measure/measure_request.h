// What `talus measure` was asked for.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <vector>

#include "imaging/drums/drum.h"
#include "imaging/photos/experiment.h"

namespace talus::trials {

struct MeasureRequest {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path out;  // nothing is written without it
  imaging::ExperimentOptions
      experiment;  // of photographs; `photos`, `runs`, `map` come from inputs
  std::optional<imaging::DrumPhotos> drum{};  // of a turning drum instead; its photographs, too,
                                              // come from inputs
  bool is_map = false;
  std::filesystem::path like;  // folder or profile whose frame and heap spheres are compared with
  int num_views = 16;          // of spheres
  std::optional<double> length_unit;  // of a sphere file [m]
};

// Each measures first and writes only when everything is understood. They print a summary.
void MeasurePhotos(const MeasureRequest& request, std::ostream& print);
void MeasureDrums(const MeasureRequest& request, std::ostream& print);
void MeasureMasses(const MeasureRequest& request, std::ostream& print);
void MeasureSpheres(const MeasureRequest& request, std::ostream& print);

// Fills `photos`, `runs` or `map` of the options from paths: one folder, one map, or photographs
// one by one (grouped by the pattern where it fits, else views of one run). Without a pattern the
// one that fits is found.
void SetSource(const std::vector<std::filesystem::path>& inputs, bool is_map,
               imaging::ExperimentOptions& options);

}  // namespace talus::trials
