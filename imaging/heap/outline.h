// The outline of a heap on an image, to a fraction of a pixel.
//
// Heights are above the baseline and columns from the left edge of the image, both in pixels. The
// outline is where the grey value, linear between pixel centres, crosses a level.
#pragma once

#include <vector>

#include "imaging/heap/profile.h"

namespace talus::imaging {

inline constexpr double kHalfIntensity = 127.5;

struct RowExtent {
  double height = 0;  // of the row's centre [px]
  double left = 0;    // where powder begins [px]
  double right = 0;   // where it ends [px]
};

struct Outline {
  std::vector<double> height;   // of the highest powder in each column [px], 0 where there is none
  std::vector<RowExtent> rows;  // with powder, from the baseline upwards
  bool empty() const { return rows.empty(); }
};

Outline FindOutline(const GrayImage& image, const Frame& frame, double level = kHalfIntensity);

}  // namespace talus::imaging
