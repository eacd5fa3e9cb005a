#include "experiments/rigs/shear_cell/yield_line.h"

#include "base/line_fit.h"

namespace talus::rigs {

std::optional<YieldLine> YieldLineOf(std::span<const StressPoint> points) {
  base::LineFit fit;
  for (const StressPoint& p : points) fit.Add(p.normal, p.shear);
  if (!fit.IsDetermined()) return std::nullopt;
  const base::StraightLine line = fit.Line();
  return YieldLine{.cohesion = line.at_zero, .slope = line.slope};
}

}  // namespace talus::rigs
