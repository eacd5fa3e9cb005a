// Where the plate is in every photograph, and the frame that the profiles share.
#pragma once

#include <vector>

#include "imaging/heap/profile.h"
#include "imaging/photos/photo_collection.h"
#include "imaging/photos/plate/plate_fit.h"

namespace talus::imaging {

struct Placement {
  Frame frame;             // of the profiles
  double photo_pixel = 0;  // [m]
  std::vector<PlatePose> poses;
  bool hidden_top = false;  // no photograph shows the plate's top: the baseline is known to 1 px
  double unseen = 0;        // share of a table's part that counts beyond the picture, at most [-]
};

// By the frame that is given, by the scale of a heap on a table, or by the plate that was found.
Placement Place(const ExperimentOptions& options, const PhotoCollection& collection);

}  // namespace talus::imaging
