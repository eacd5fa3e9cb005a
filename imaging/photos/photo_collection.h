// The photographs of an experiment that can be used together, and what is wrong with the others.
#pragma once

#include <string>
#include <vector>

#include "imaging/photos/experiment.h"
#include "imaging/photos/photo_reading.h"
#include "imaging/photos/photo_set.h"

namespace talus::imaging {

struct PhotoCollection {
  std::vector<std::string> runs;  // names
  std::vector<Photo> photos;      // usable ones, run by run
  int width = 0;                  // of every photograph's file [px]
  int height = 0;                 // [px]
  int block = 1;                  // as in Photograph
  std::vector<UnusablePhoto> left_out;
  std::vector<PhotoWarning> warnings;
};

std::string PixelSizeText(int width, int height);  // 640 x 480 px

// Keeps what is of one size and scale. Faults end the work with an UnusablePhotosError, or, with
// `allow_missing_views`, become warnings.
PhotoCollection CollectPhotos(const ExperimentOptions& options, const PhotoSet& set,
                              std::vector<Photo> photos);

}  // namespace talus::imaging
