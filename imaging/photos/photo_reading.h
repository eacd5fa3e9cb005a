// What each photograph shows by itself: its light taken out, and where its plate or table is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "imaging/light/backlight.h"
#include "imaging/photos/experiment.h"
#include "imaging/photos/photo_set.h"
#include "imaging/photos/plate/plate_edges.h"
#include "imaging/photos/table_line.h"

namespace talus::imaging {

struct Photo {
  std::filesystem::path path;
  std::size_t run = 0;
  int width = 0;                        // of the file [px]; 0: unreadable
  int height = 0;                       // [px]
  int block = 1;                        // as in Photograph; all else is in pixels of its image [px]
  PlateEdges edges;                     // unless the frame or a scale is given
  TableLine table;                      // with a scale
  bool front_lit = false;               // powder is brighter than its background
  double overexposed = 0;               // as in BacklitPhoto [-]
  double light = 0;                     // as in BacklitPhoto [grey levels]
  std::optional<std::int64_t> taken{};  // as in DatedImage [s]
  std::string fault;                    // why it cannot be used, with the file's name; "": it can
  bool has_light = false;               // it could be made independent of its light
  bool lacks_plate = false;             // the fault is that no plate or table of use was found
  BacklitPhoto flat;  // empty where all of them together would take too much memory
};

// All of the set, run by run, each read once; one that cannot be used says so in `fault`.
std::vector<Photo> ReadPhotos(const ExperimentOptions& options, const PhotoSet& set);

// What base::ParallelFor is told of one photograph: worth a thread of its own.
inline constexpr double kPhotoWork = 1e9;

}  // namespace talus::imaging
