// Where the plate is in every photograph of an experiment, all of them fitted together.
//
// One camera took them, so the plate's width and thickness are shared; each photograph has its own
// centre, baseline and tilt. The thickness ties the baseline, which powder hides on most of the
// photographs, to the lower edge, which it leaves to be seen; where the lower edge is not seen, the
// photographs of a run hold their baselines together. Least squares over all edge points, with a
// loss that lets grains at the corners drop out.
#pragma once

#include <span>
#include <vector>

#include "imaging/photos/plate/plate_edges.h"

namespace talus::imaging {

// Where the plate stands in one photograph.
struct PlatePose {
  double width = 0;     // as this photograph alone has it [px]
  double center_x = 0;  // of its top edge [px] from the left edge of the photograph
  double baseline = 0;  // of the middle of its top edge [px] from the top edge
  double tilt = 0;      // [rad], > 0 if the right end is lower
};

struct PlateFit {
  double width = 0;              // shared [px]
  bool sharp_corners = false;    // false: no photograph shows the plate's top; baseline to 1 px
  std::vector<PlatePose> poses;  // in the order of the photographs
};

struct PhotographedPlate {
  PlateEdges edges;
  std::size_t run = 0;  // photographs of one run follow each other
};

PlateFit FitPlates(std::span<const PhotographedPlate> plates);

}  // namespace talus::imaging
