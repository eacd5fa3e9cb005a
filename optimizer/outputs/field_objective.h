// What is minimised when an evaluation is an image: a metric of the image, so that it can be worked
// out on predicted images too.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/problems.h"

namespace talus::optimizer {

// Fields are row by row from the top, in [0, 1] with 1 = powder.
struct FieldObjective {
  int width = 0;                   // [px]
  int height = 0;                  // [px]
  std::vector<float> target = {};  // the measured field; may be empty with a metric of its own

  // The objective is the sum of absolute differences, sad_scale Σ |field - target|, whose
  // expectation has a closed form …
  double sad_scale = 0;  // > 0, such as the area of a pixel; unused beside a metric
  // … unless this is set: any other functional of a field, such as |angle of repose - reference|.
  std::function<double(std::span<const float>)> metric = {};

  // The target is the mean of so many heaps, each as noisy as an evaluation: then it is not known
  // exactly either, and credible intervals are wider. 0: it is exact.
  int num_target_heaps = 0;

  double Value(std::span<const float> field) const;
  std::size_t num_pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::optimizer
