// The scale factors of a search: the target, where they lie between it and the coarsest, and how
// noise goes with them.
#pragma once

#include <cmath>
#include <vector>

namespace talus::optimizer {

// Noise sd of one heap at the scale factor `to` over that at `from`. Heaps have N ∝ f⁻³ grains, and
// a mean over N of them scatters as N^(-1/2).
inline double NoiseRatio(double to, double from) { return std::pow(to / from, 1.5); }

class Levels {
 public:
  // `scale_factors` distinct, in any order; `target` <= all of them, 0 for the least.
  Levels(std::vector<double> scale_factors, double target);

  int size() const { return static_cast<int>(factors_.size()); }
  double factor(int level) const { return factors_[static_cast<std::size_t>(level)]; }
  double target() const { return target_; }
  int finest() const { return size() - 1; }
  bool is_extrapolated() const { return factor(finest()) > target_; }

  // (f - f_target)/(f_coarsest - f_target); 0 at the target, 1 at the coarsest.
  double growth(int level) const;

  // Level of a scale factor; the nearest one where it is none of them.
  int LevelOf(double factor) const;

  // Noise sd of one heap at the target over that at `level`.
  double NoiseAtTarget(int level) const { return NoiseRatio(target_, factor(level)); }

 private:
  std::vector<double> factors_;  // coarsest first
  double target_ = 1;
};

}  // namespace talus::optimizer
