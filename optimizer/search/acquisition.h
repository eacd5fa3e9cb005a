// How promising a point is, from the posterior mean μ and standard deviation s of the objective.
// All are larger for better points; the slopes are the derivatives with respect to μ and s.
//
//   z = (m - μ) / s                     m: the incumbent, the lowest posterior mean
//   ln EI = ln s + ln h(z),             h(z) = φ(z) + z Φ(z), expected improvement [jones1998]
//   LCB   = -(μ - k s)
//
// ln h is summed without cancellation for very negative z [ament2023], where EI itself is 0 in
// double precision and has no slope to follow.
#pragma once

namespace talus::optimizer {

struct Acquisition {
  double value = 0;
  double mean_slope = 0;  // d value / dμ
  double sd_slope = 0;    // d value / ds
};

Acquisition LogExpectedImprovement(double mean, double sd, double incumbent);

// Expected improvement weighted for noise [huang2006]: EI (1 - n / √(s² + n²)), which does not
// return to points where one more noisy evaluation would change little. In log form.
Acquisition AugmentedLogExpectedImprovement(double mean, double sd, double incumbent, double noise);

Acquisition NegativeLowerBound(double mean, double sd, double num_sds);

}  // namespace talus::optimizer
