// An experiment's photographs as they are to be used: read, with the plate's edges in each, and all
// that is wrong with them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "imaging/photos/experiment.h"
#include "imaging/photos/plate/plate_edges.h"
#include "imaging/photos/table_line.h"

namespace talus::imaging {

struct Photo {
  std::filesystem::path path;
  std::size_t run = 0;
  PlateEdges edges;        // unless the frame or a scale is given
  TableLine table;         // with a scale
  bool front_lit = false;  // powder is brighter than its background
  GrayImage image;         // empty where all of them together would take too much memory
};

struct PhotoFault {
  std::filesystem::path photo;  // empty for one that is missing
  std::string reason;           // names the file
};

struct PhotoCollection {
  std::vector<std::string> runs;  // names
  std::vector<Photo> photos;      // usable ones, run by run
  int width = 0;                  // of every photograph [px]
  int height = 0;                 // [px]
  std::vector<PhotoFault> faults;
};

// Reads every photograph, and keeps it as long as all fit into 256 MB. Faults end the work with a
// ConfigError that lists them all, or, with `allow_missing_views`, become warnings. The faulty
// photographs that can be drawn go to `keep`.
PhotoCollection CollectPhotos(const ExperimentOptions& options, const PictureSink& keep,
                              std::vector<PhotoWarning>& warnings);

// A photograph made independent of its light, as the options say what it shows: a plate or a table.
BacklitPhoto Flatten(const ExperimentOptions& options, const GrayImage& image,
                     const std::filesystem::path& photo);

// Calls body(i) for each of the photographs, several at once.
void ForEachPhoto(std::size_t num_photos, const std::function<void(std::size_t)>& body);

}  // namespace talus::imaging
