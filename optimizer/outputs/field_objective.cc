#include "optimizer/outputs/field_objective.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace talus::optimizer {

double FieldObjective::Value(std::span<const float> field) const {
  if (metric) return metric(field);
  double sum = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    sum += std::abs(static_cast<double>(field[i]) - static_cast<double>(target[i]));
  }
  return sad_scale * sum;
}

void FieldObjective::Validate(base::Problems& problems) const {
  problems.Require(width >= 1, "width", width, "must be at least 1");
  problems.Require(height >= 1, "height", height, "must be at least 1");
  if (width < 1 || height < 1) return;
  problems.Require(target.size() == num_pixels() || (target.empty() && metric), "target",
                   "has " + std::to_string(target.size()) + " pixels, must have " +
                       std::to_string(width) + " x " + std::to_string(height) +
                       (metric ? ", or none" : ""));
  // Means of many heaps are off by their rounding.
  constexpr float kRounding = 1e-3F;
  problems.Require(
      std::ranges::all_of(
          target, [](float pixel) { return pixel >= -kRounding && pixel <= 1 + kRounding; }),
      "target", "must have values from 0 to 1, 1 = powder");
  problems.Require(metric || (sad_scale > 0 && std::isfinite(sad_scale)), "sad_scale", sad_scale,
                   "must be positive");
  problems.Require(num_target_heaps >= 0, "num_target_heaps", num_target_heaps,
                   "must not be negative");
}

}  // namespace talus::optimizer
