// Where a heap's slopes begin and end: what every angle of repose is measured between.
#pragma once

#include <vector>

#include "imaging/heap/outline.h"

namespace talus::imaging {

struct SlopePoint {
  double across = 0;  // from the heap's axis outwards [px]
  double height = 0;  // [px]
};

// One side, seen from the heap's axis outwards, so that both sides look alike.
struct Slope {
  double foot = 0;                 // across, where the slope meets the baseline [px]
  double shoulder = 0;             // across, where it meets the top [px]; 0 unless the top is flat
  std::vector<SlopePoint> points;  // of the outline, from shoulder to foot
};

struct HeapShape {
  double axis = 0;    // under the middle of the top: from the image's left edge [px]
  double height = 0;  // [px]
  Slope left;
  Slope right;
};

// `outline` must not be empty.
HeapShape FindHeapShape(const Outline& outline);

// How far the outline steps outwards going up [px], on each side: 0 for a heap that narrows.
struct Overhang {
  double left = 0;
  double right = 0;
};
Overhang FindOverhang(const Outline& outline);

// The larger one of two outlines of a heap, side by side.
Overhang WorstOverhang(const Outline& one, const Outline& other);

}  // namespace talus::imaging
