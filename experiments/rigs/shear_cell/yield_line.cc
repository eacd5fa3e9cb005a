#include "experiments/rigs/shear_cell/yield_line.h"

namespace talus::rigs {

std::optional<YieldLine> YieldLineOf(std::span<const StressPoint> points) {
  StressPoint mean;
  for (const StressPoint& p : points) {
    mean.normal += p.normal / static_cast<double>(points.size());
    mean.shear += p.shear / static_cast<double>(points.size());
  }
  double square = 0;
  double product = 0;
  for (const StressPoint& p : points) {
    square += (p.normal - mean.normal) * (p.normal - mean.normal);
    product += (p.normal - mean.normal) * (p.shear - mean.shear);
  }
  if (!(square > 0)) return std::nullopt;
  const double slope = product / square;
  return YieldLine{.cohesion = mean.shear - slope * mean.normal, .slope = slope};
}

}  // namespace talus::rigs
