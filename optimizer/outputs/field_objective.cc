#include "optimizer/outputs/field_objective.h"

#include <cmath>

namespace talus::optimizer {

double FieldObjective::Value(std::span<const float> field) const {
  if (metric) return metric(field);
  double sum = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    sum += std::abs(static_cast<double>(field[i]) - static_cast<double>(target[i]));
  }
  return sad_scale * sum;
}

}  // namespace talus::optimizer
